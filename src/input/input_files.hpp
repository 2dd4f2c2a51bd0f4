/// Every file that a job reads: opened once, unpacked where gzipped, hashed, remembered.
/// Files of data are brought to UTF-8.
#pragma once

#include "input/csv.hpp"

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace bemcal::description {
class WeatherMemory;  // of a stock, carried along for its readers
}

namespace bemcal::input {

struct InputFile {
    std::filesystem::path path;
    std::string hash;  ///< of its content
};

/// The bytes of a file. Throws UserError (no_input, io) where it cannot be read or is
/// empty.
std::string read_bytes(const std::filesystem::path& path);

/// Of a file's content as it lies on the disk; "" where it cannot be read.
std::string file_hash(const std::filesystem::path& path);

/// Text behind gzip's format (RFC 1952); throws UserError (data) naming `path` where it
/// is damaged or unpacks to more than 4 GB.
std::string unpack_gzip(const std::string& bytes, const std::string& path);

class InputFiles {
  public:
    using Reader = std::function<std::string(const std::filesystem::path&)>;
    explicit InputFiles(Reader reader = read_bytes) : reader_(std::move(reader)) {}
    /// The text of a file, unpacked if it is gzipped. The reference stays valid.
    /// \param named_at  where the job names it, for the message if it cannot be read
    const std::string& text(const std::filesystem::path& path,
                            const std::string& named_at = "");
    /// The same as UTF-8, for files of data: Latin-1 is converted; a zip, a workbook, a
    /// web page, UTF-16 are refused by name.
    std::string_view data(const std::filesystem::path& path,
                          const std::string& named_at = "");
    /// The file as CSV; parsed once for each form.
    const Csv& csv(const std::filesystem::path& path, const std::string& named_at = "",
                   const CsvForm& form = {});
    const std::vector<InputFile>& log() const { return log_; }

    /// Of a stock: weathers that were read already; empty = there are none.
    std::shared_ptr<description::WeatherMemory> weathers;
    /// A file that was read before by somebody else.
    void note(const std::filesystem::path& path, const std::string& hash);

  private:
    Reader reader_;
    std::map<std::string, std::string> texts_;
    std::map<std::string, std::string>
        data_;  ///< converted, or "" where the text is data
    std::map<std::string, std::unique_ptr<Csv>> tables_;
    std::vector<InputFile> log_;
};

}  // namespace bemcal::input
