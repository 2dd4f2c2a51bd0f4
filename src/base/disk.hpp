/// Files that are safe once written: under a fresh name that follows no link, every call
/// checked, on the disk before they take their place; and what file a name stands for.
///
/// Errors are UserErrors: cannot_create where the place is at fault (rights, a name that
/// is too long), io where the disk is.
#pragma once

#include <compare>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace bemcal {

/// Device and inode: the same for every name of a file, through links too.
struct FileId {
    std::uint64_t device = 0, inode = 0;
    auto operator<=>(const FileId&) const = default;
};

/// Links are followed; none: nothing is there.
std::optional<FileId> file_id(const std::filesystem::path& path);

/// Whether the name is taken, by a link that leads nowhere too.
bool is_taken(const std::filesystem::path& path);

/// In which it lies: "." where it has none.
std::filesystem::path folder_of(const std::filesystem::path& path);

/// Throws UserError: what could not be done, and why (errno).
[[noreturn]] void fail_at(const std::filesystem::path& path, const char* doing,
                          int error);

/// The content of a file. Throws UserError: no_input where it cannot be opened, data
/// where the name stands for a folder, a pipe or a device, io where reading fails.
std::string read_regular(const std::filesystem::path& path);

/// Entries of a folder are on the disk on return, where it can be told to.
void sync_folder(const std::filesystem::path& folder);

/// Writes all of it, in as many calls as it takes.
void write_all(int file, std::string_view bytes, const std::filesystem::path& path);

/// Whether a file may take the place of another.
enum class Replace { no, yes };

class FreshFile {
  public:
    /// FOLDER/NAME.XXXXXX, which was not there before.
    FreshFile(const std::filesystem::path& folder, const std::string& name);
    ~FreshFile();  ///< removes it unless it took its place
    FreshFile(const FreshFile&) = delete;
    FreshFile& operator=(const FreshFile&) = delete;

    const std::filesystem::path& path() const { return path_; }
    void write(std::string_view bytes);
    /// To the disk, then under its name, and that to the disk as well. Throws UserError
    /// (cannot_create) where the name is taken and may not be replaced.
    void move_to(const std::filesystem::path& place, Replace replace);

  private:
    void sync_and_close();

    std::filesystem::path path_;
    int file_ = -1;
    FileId id_;
    bool is_placed_ = false;
};

/// A whole text under that name, or what was there before.
void replace_file(const std::filesystem::path& path, std::string_view text);

/// Whether a file in a part folder or beside a result is one that FreshFile left of that
/// name: NAME.XXXXXX.
bool is_fresh_name(const std::string& file, const std::string& name);

}  // namespace bemcal
