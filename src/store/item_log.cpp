/// Finished items as records in a log of each rank: packed, with a checksum, appended;
/// read back with cut or damaged records left out.
/// Plain format of our own, in the machine's byte order. Of several answers the one with
/// the fewest failures counts. What an answer means is the stage's.
#include "store/item_log.hpp"

#include "base/error.hpp"
#include "base/hash.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

namespace bemcal::store {
namespace {

constexpr char magic[8] = {'\x89', 'b', 'e', 'm', 'i', 't', 'e', 'm'};

struct Header {
    char mark[8];
    ItemKey key;
    std::uint64_t bytes;
    std::uint64_t checksum;  ///< of key and bytes with the packed answer
};

std::uint64_t checksum_of(const Header& header, const std::byte* packed) {
    const std::uint64_t parts[2] = {
        checksum64(&header.key, offsetof(Header, checksum) - offsetof(Header, key)),
        checksum64(packed, header.bytes)};
    return checksum64(parts, sizeof parts);
}

template <class Value>
void put(std::vector<std::byte>& out, const Value& value) {
    const auto* raw = reinterpret_cast<const std::byte*>(&value);
    out.insert(out.end(), raw, raw + sizeof value);
}

void put_text(std::vector<std::byte>& out, const std::string& text) {
    put(out, static_cast<std::uint64_t>(text.size()));
    const auto* raw = reinterpret_cast<const std::byte*>(text.data());
    out.insert(out.end(), raw, raw + text.size());
}

/// Takes values from the front of a packed answer.
class Unpacker {
  public:
    Unpacker(const std::byte* data, std::size_t bytes) : data_(data), left_(bytes) {}

    template <class Value>
    Value get() {
        Value value;
        copy(&value, sizeof value);
        return value;
    }
    std::string get_text() {
        std::string text(count(1), '\0');
        copy(text.data(), text.size());
        return text;
    }
    std::vector<double> get_values() {
        std::vector<double> values(count(sizeof(double)));
        copy(values.data(), values.size() * sizeof(double));
        return values;
    }

    /// A count of things of at least that size, checked against what is left.
    std::size_t count(std::size_t size) {
        const auto n = get<std::uint64_t>();
        require(n <= left_ / size, "a packed answer is cut short");
        return n;
    }

  private:
    void copy(void* to, std::size_t bytes) {
        require(bytes <= left_, "a packed answer is cut short");
        if (bytes > 0) std::memcpy(to, data_, bytes);
        data_ += bytes;
        left_ -= bytes;
    }

    const std::byte* data_;
    std::size_t left_;
};

[[noreturn]] void fail(const std::filesystem::path& path, const char* doing, int error) {
    throw UserError(
        error == EACCES || error == EROFS ? ExitCode::cannot_create : ExitCode::io,
        fmt::format("{}: cannot {}: {}", path.string(), doing, std::strerror(error)));
}

std::vector<std::byte> bytes_of(const std::filesystem::path& path) {
    std::ifstream in(path, std::ios::binary | std::ios::ate);
    if (!in) fail(path, "open the log", errno);
    std::vector<std::byte> bytes(static_cast<std::size_t>(in.tellg()));
    in.seekg(0);
    in.read(reinterpret_cast<char*>(bytes.data()),
            static_cast<std::streamsize>(bytes.size()));
    if (!in) fail(path, "read the log", EIO);
    return bytes;
}

/// The record that begins at `at`, if a whole and sound one does.
std::optional<Header> header_at(const std::vector<std::byte>& log, std::size_t at) {
    Header header;
    if (log.size() - at < sizeof header) return {};
    std::memcpy(&header, log.data() + at, sizeof header);
    if (std::memcmp(header.mark, magic, sizeof magic) != 0) return {};
    if (header.bytes > log.size() - at - sizeof header) return {};
    if (header.checksum != checksum_of(header, log.data() + at + sizeof header))
        return {};
    return header;
}

std::size_t next_mark(const std::vector<std::byte>& log, std::size_t from) {
    const auto* mark = reinterpret_cast<const std::byte*>(magic);
    const auto found = std::search(log.begin() + static_cast<std::ptrdiff_t>(from),
                                   log.end(), mark, mark + sizeof magic);
    return static_cast<std::size_t>(found - log.begin());
}

/// A failed item counts as more than all of its points.
std::size_t n_failures(const std::vector<std::byte>& packed) {
    const study::ItemAnswer answer = unpack(packed.data(), packed.size());
    return answer.error.empty() ? answer.failures.size() : SIZE_MAX;
}

/// Where each key's record stands.
using Places = std::map<ItemKey, std::size_t>;

void take(LogContent::Record record, Places& places, LogContent& content) {
    const auto [place, is_new] = places.emplace(record.key, content.records.size());
    if (is_new)
        content.records.push_back(std::move(record));
    else if (auto& other = content.records[place->second];
             n_failures(record.packed) < n_failures(other.packed))
        other = std::move(record);
}

void read_log(const std::vector<std::byte>& log, Places& places, LogContent& content) {
    for (std::size_t at = 0; at < log.size();) {
        const auto header = header_at(log, at);
        if (!header) {
            ++content.n_damaged;
            at = next_mark(log, at + 1);
            continue;
        }
        const auto* packed = log.data() + at + sizeof(Header);
        take({header->key, {packed, packed + header->bytes}}, places, content);
        at += sizeof(Header) + header->bytes;
    }
}

}  // namespace

std::vector<std::byte> pack(const study::ItemAnswer& answer) {
    std::vector<std::byte> out;
    out.reserve(24 + answer.values.size() * sizeof(double) + answer.error.size() +
                answer.failures.size() * 64);
    put(out, static_cast<std::uint64_t>(answer.values.size()));
    const auto* raw = reinterpret_cast<const std::byte*>(answer.values.data());
    out.insert(out.end(), raw, raw + answer.values.size() * sizeof(double));
    put(out, static_cast<std::uint64_t>(answer.failures.size()));
    for (const study::Failure& failure : answer.failures) {
        put(out, static_cast<std::int64_t>(failure.point));
        put_text(out, failure.reason);
    }
    put_text(out, answer.error);
    return out;
}

study::ItemAnswer unpack(const std::byte* data, std::size_t bytes) {
    Unpacker in(data, bytes);
    study::ItemAnswer answer;
    answer.values = in.get_values();
    const std::size_t n_failures = in.count(16);
    for (std::size_t k = 0; k < n_failures; ++k) {
        const auto point = in.get<std::int64_t>();
        answer.failures.push_back({point, in.get_text()});
    }
    answer.error = in.get_text();
    return answer;
}

ItemLog::ItemLog(const std::filesystem::path& folder, int rank)
    : path_(folder / fmt::format("rank-{}.log", rank)) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) fail(folder, "create the folder", error.value());
    file_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    if (file_ < 0) fail(path_, "create the log", errno);
}

ItemLog::~ItemLog() {
    ::close(file_);
}

void ItemLog::append(const ItemKey& key, const std::vector<std::byte>& packed) {
    Header header{};
    std::copy(std::begin(magic), std::end(magic), header.mark);
    header.key = key;
    header.bytes = packed.size();
    header.checksum = checksum_of(header, packed.data());
    std::vector<std::byte> record(sizeof header + packed.size());
    std::memcpy(record.data(), &header, sizeof header);
    if (!packed.empty())
        std::memcpy(record.data() + sizeof header, packed.data(), packed.size());
    for (std::size_t done = 0; done < record.size();) {
        const ssize_t n = ::write(file_, record.data() + done, record.size() - done);
        if (n < 0 && errno != EINTR) fail(path_, "write", errno);
        if (n > 0) done += static_cast<std::size_t>(n);
    }
}

void ItemLog::sync() {
    if (::fdatasync(file_) != 0) fail(path_, "write to the disk", errno);
}

LogContent read_logs(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> logs;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        if (entry.path().extension() == ".log") logs.push_back(entry.path());
    std::sort(logs.begin(), logs.end());
    LogContent content;
    Places places;
    for (const auto& log : logs) read_log(bytes_of(log), places, content);
    return content;
}

}  // namespace bemcal::store
