/// Reads each file of a job once: bytes, content hash, gzip unpacked, CSV parsed. Texts
/// stay for as long as the job is read.
/// Source: gzip, RFC 1952, by zlib.
/// Leaves out other compressions, files that unpack to over 4 GB, and what contents mean.
#include "input/input_files.hpp"

#include "base/error.hpp"
#include "base/hash.hpp"
#include "base/machine.hpp"
#include "input/data_text.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <zlib.h>

namespace bemcal::input {

namespace {

constexpr std::size_t most_unpacked = std::size_t{4} << 30;

bool is_gzip(const std::string& bytes) {
    return bytes.size() >= 2 && bytes[0] == '\x1f' && bytes[1] == '\x8b';
}

/// zlib's stream, ended when it goes.
struct Inflater {
    z_stream stream{};
    Inflater() { ok = inflateInit2(&stream, 15 + 16) == Z_OK; }  // 16: a gzip header
    ~Inflater() { inflateEnd(&stream); }
    Inflater(const Inflater&) = delete;
    Inflater& operator=(const Inflater&) = delete;
    bool ok = false;
};

std::string hash_of(const std::string& bytes) {
    Hasher hasher;
    hasher.add(bytes.data(), bytes.size());
    return hasher.hex();
}

[[noreturn]] void fail_gzip(const std::string& path, const char* what) {
    throw UserError(
        ExitCode::data,
        fmt::format("{}: {}; unpack it with gunzip to see what is left", path, what));
}

/// Which table of a file it is: meters that read other columns of it share one.
std::string key_of(const std::string& path, const CsvForm& form, const CsvNames& names) {
    return fmt::format("{}\n{} {} {} {} {} {} {}", path, names.line, names.separator,
                       form.time, form.header_line, form.names.empty(),
                       fmt::join(form.skip_lines, ","), fmt::join(form.skip_texts, "\n"));
}

/// What would be waited for, or read without end; nullptr = a file, one that is missing,
/// or the pipe of a shell, like <(...).
const char* what_is_no_file(const std::filesystem::path& path) {
    using enum std::filesystem::file_type;
    constexpr std::pair<std::filesystem::file_type, const char*> others[] = {
        {directory, "a folder"},
        {character, "a device"},
        {block, "a device"},
        {socket, "a socket"},
        {fifo, "a pipe"}};
    std::error_code ignored;
    const auto type = std::filesystem::status(path, ignored).type();
    if (type == fifo && path.native().starts_with("/dev/")) return nullptr;
    const auto* const found = std::ranges::find(
        others, type, &std::pair<std::filesystem::file_type, const char*>::first);
    return found == std::end(others) ? nullptr : found->second;
}

}  // namespace

std::string read_bytes(const std::filesystem::path& path) {
    if (const char* other = what_is_no_file(path))
        throw UserError(ExitCode::no_input,
                        fmt::format("{}: is {}; expected a file", path.string(), other));
    std::ifstream in(path, std::ios::binary);
    if (!in && is_of_machine(errno))
        throw MachineError(errno, fmt::format("{}: cannot be opened: {}", path.string(),
                                              std::strerror(errno)));
    if (!in)
        throw UserError(ExitCode::no_input,
                        fmt::format("{}: cannot be opened ({})", path.string(),
                                    std::strerror(errno)));
    std::error_code ignored;
    const std::uintmax_t size = std::filesystem::file_size(path, ignored);
    std::string bytes(ignored ? 0 : size, '\0');
    in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    bytes.resize(static_cast<std::size_t>(in.gcount()));
    // What has no size, a pipe say, or has grown.
    if (!in.bad()) bytes.append(std::istreambuf_iterator<char>(in), {});
    if (in.bad())
        throw UserError(ExitCode::io, fmt::format("{}: reading failed", path.string()));
    if (bytes.empty())
        throw UserError(ExitCode::data,
                        fmt::format("{}: the file is empty", path.string()));
    return bytes;
}

std::string file_hash(const std::filesystem::path& path) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored)) return {};  // nor waited for
    try {
        return hash_of(read_bytes(path));
    } catch (const UserError&) {
        return {};  // a file that is missing has a state, too
    }
}

std::string unpack_gzip(const std::string& bytes, const std::string& path) {
    Inflater inflater;
    z_stream& stream = inflater.stream;
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    stream.avail_in = static_cast<uInt>(bytes.size());
    std::string text;
    std::vector<char> block(1 << 18);
    int state = inflater.ok ? Z_OK : Z_MEM_ERROR;
    while (state == Z_OK && text.size() < most_unpacked) {
        stream.next_out = reinterpret_cast<Bytef*>(block.data());
        stream.avail_out = static_cast<uInt>(block.size());
        state = inflate(&stream, Z_NO_FLUSH);
        text.append(block.data(), block.size() - stream.avail_out);
        if (state == Z_STREAM_END &&
            stream.avail_in > 0)  // members may follow each other
            state = inflateReset(&stream);
    }
    if (state == Z_BUF_ERROR) fail_gzip(path, "the gzipped file is cut off");
    if (state == Z_OK) fail_gzip(path, "the gzipped file holds more than 4 GB");
    if (state != Z_STREAM_END) fail_gzip(path, "the gzipped file is damaged");
    return text;
}

const std::string& InputFiles::text(const std::filesystem::path& path,
                                    const std::string& named_at) {
    const auto known = texts_.find(path.string());
    if (known != texts_.end()) return known->second;
    std::string bytes;
    try {
        bytes = reader_(path);
    } catch (const UserError& error) {
        note(path, "");
        if (named_at.empty()) throw;
        throw UserError(error.exit_code(), fmt::format("{}: {}", named_at, error.what()));
    }
    log_.push_back({path, hash_of(bytes)});
    if (is_gzip(bytes)) bytes = unpack_gzip(bytes, path.string());
    return texts_.emplace(path.string(), std::move(bytes)).first->second;
}

void InputFiles::note(const std::filesystem::path& path, const std::string& hash) {
    log_.push_back({path, hash});
}

std::string_view InputFiles::data(const std::filesystem::path& path,
                                  const std::string& named_at) {
    const std::string& bytes = text(path, named_at);
    const auto known = data_.find(path.string());
    if (known != data_.end()) return known->second.empty() ? bytes : known->second;
    refuse_other_kinds(bytes, path.string());
    std::string& made = data_[path.string()];
    if (!is_utf8(bytes)) made = from_windows_1252(bytes);
    return made.empty() ? bytes : made;
}

const Csv& InputFiles::csv(const std::filesystem::path& path, const std::string& named_at,
                           const CsvForm& form) {
    const std::string_view text = data(path, named_at);
    const CsvNames names = find_names(text, path.string(), form);
    std::unique_ptr<Csv>& table = tables_[key_of(path.string(), form, names)];
    if (!table)
        table = std::make_unique<Csv>(parse_csv(text, path.string(), form, names));
    return *table;
}

}  // namespace bemcal::input
