/// Finished items as records in a log of each rank: packed, with a checksum, appended;
/// read back with records left out that are cut, damaged or another run's.
/// Plain format of our own, in the machine's byte order. What is stored is the checksum
/// of the record, turned by the mark of its run: so a sound record tells whose it is. Of
/// several answers the one with the fewest failures counts. What an answer means is the
/// stage's.
#include "store/item_log.hpp"

#include "base/disk.hpp"
#include "base/error.hpp"
#include "base/hash.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

namespace bemcal::store {
namespace {

namespace fs = std::filesystem;

constexpr char magic[8] = {'\x89', 'b', 'e', 'm', 'i', 't', 'e', 'm'};

struct Header {
    char mark[8];
    ItemKey key;
    std::uint64_t bytes;
    std::uint64_t checksum;  ///< of key and bytes with the packed answer, and the run
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

/// What begins at a place of a log, if a whole record does.
struct Found {
    Header header{};
    const std::byte* packed = nullptr;
    RunMark run = 0;  ///< whose it is, if it is sound; anything if it is not
};

std::optional<Found> record_at(std::string_view log, std::size_t at) {
    Found found;
    if (log.size() - at < sizeof found.header) return {};
    std::memcpy(&found.header, log.data() + at, sizeof found.header);
    if (std::memcmp(found.header.mark, magic, sizeof magic) != 0) return {};
    if (found.header.bytes > log.size() - at - sizeof(Header)) return {};
    found.packed = reinterpret_cast<const std::byte*>(log.data()) + at + sizeof(Header);
    found.run = found.header.checksum ^ checksum_of(found.header, found.packed);
    return found;
}

std::size_t end_of(const Found& found, std::size_t at) {
    return at + sizeof(Header) + found.header.bytes;
}

std::size_t next_mark(std::string_view log, std::size_t from) {
    return std::min(log.find(std::string_view(magic, sizeof magic), from), log.size());
}

/// How often each run's mark was found; that of a damaged record is nobody's.
using Votes = std::map<RunMark, int>;

/// Of records that end where another begins, or with the log.
void count_votes(std::string_view log, Votes& votes) {
    for (std::size_t at = 0; at < log.size();) {
        const auto found = record_at(log, at);
        const std::size_t end = found ? end_of(*found, at) : 0;
        const bool is_whole = found && (end == log.size() || next_mark(log, end) == end);
        if (is_whole) ++votes[found->run];
        at = is_whole ? end : next_mark(log, at + 1);
    }
}

RunMark most_voted(const Votes& votes) {
    const auto most = std::ranges::max_element(votes, {}, &Votes::value_type::second);
    return most == votes.end() ? 0 : most->first;
}

/// Whether an answer comes out of it: a checksum finds accidents, not forgery.
bool is_answer(const Found& found) {
    try {
        unpack(found.packed, found.header.bytes);
        return true;
    } catch (const std::logic_error&) {
        return false;
    }
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

/// \param others  the marks of sound or damaged records that are not the run's
void read_log(std::string_view log, RunMark run, Places& places, LogContent& content,
              Votes& others) {
    for (std::size_t at = 0; at < log.size();) {
        const auto found = record_at(log, at);
        const bool is_ours = found && found->run == run && is_answer(*found);
        if (is_ours)
            take(
                {found->header.key, {found->packed, found->packed + found->header.bytes}},
                places, content);
        else if (found && found->run != run)
            ++others[found->run];
        else
            ++content.n_damaged;
        at = is_ours ? end_of(*found, at) : next_mark(log, at + 1);
    }
}

/// A mark that several records have is a run's; one that stands alone is damage.
void judge_others(const std::vector<std::pair<fs::path, Votes>>& others,
                  LogContent& content) {
    Votes all;
    for (const auto& [log, votes] : others)
        for (const auto& [run, n] : votes) all[run] += n;
    for (const auto& [run, n] : all) (n > 1 ? content.n_foreign : content.n_damaged) += n;
    for (const auto& [log, votes] : others)
        if (std::ranges::any_of(votes,
                                [&](const auto& vote) { return all[vote.first] > 1; }))
            content.foreign.push_back(log);
}

std::vector<fs::path> logs_in(const fs::path& folder) {
    std::vector<fs::path> logs;
    for (const auto& entry : fs::directory_iterator(folder))
        if (is_log_name(entry.path().filename().string())) logs.push_back(entry.path());
    std::sort(logs.begin(), logs.end());
    return logs;
}

fs::path log_name(const fs::path& folder, int rank, int number) {
    return folder / (number == 1 ? fmt::format("rank-{}.log", rank)
                                 : fmt::format("rank-{}-{}.log", rank, number));
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

ItemLog::ItemLog(const fs::path& folder, int rank, RunMark run) : run_(run) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) fail_at(folder, "create the folder", error.value());
    for (int number = 1; file_ < 0; ++number) {
        path_ = log_name(folder, rank, number);
        file_ =
            ::open(path_.c_str(),
                   O_WRONLY | O_CREAT | O_EXCL | O_APPEND | O_NOFOLLOW | O_CLOEXEC, 0666);
        if (file_ < 0 && errno != EEXIST) fail_at(path_, "create the log", errno);
    }
}

ItemLog::~ItemLog() {
    if (file_ >= 0) ::close(file_);
}

void ItemLog::append(const ItemKey& key, const std::vector<std::byte>& packed) {
    Header header{};
    std::copy(std::begin(magic), std::end(magic), header.mark);
    header.key = key;
    header.bytes = packed.size();
    header.checksum = checksum_of(header, packed.data()) ^ run_;
    std::string record(sizeof header + packed.size(), '\0');
    std::memcpy(record.data(), &header, sizeof header);
    if (!packed.empty())
        std::memcpy(record.data() + sizeof header, packed.data(), packed.size());
    write_all(file_, record, path_);
    bytes_ += record.size();
}

void ItemLog::sync() {
    if (::fdatasync(file_) != 0 && errno != EINVAL)
        fail_at(path_, "write to the disk", errno);
}

void ItemLog::close() {
    sync();
    if (::close(std::exchange(file_, -1)) != 0) fail_at(path_, "close", errno);
}

std::string ItemLog::trouble() const {
    struct stat mine{}, there{};
    if (::fstat(file_, &mine) != 0 || ::lstat(path_.c_str(), &there) != 0)
        return path_.string() + ": was removed while the run was writing it";
    if (mine.st_dev != there.st_dev || mine.st_ino != there.st_ino)
        return path_.string() + ": was replaced while the run was writing it";
    if (static_cast<std::uint64_t>(mine.st_size) != bytes_)
        return path_.string() +
               ": was changed by another program while the run was "
               "writing it";
    return {};
}

bool is_log_name(const std::string& name) {
    constexpr std::string_view first = "rank-", last = ".log", digits = "-0123456789";
    return name.size() > first.size() + last.size() && name.starts_with(first) &&
           name.ends_with(last) &&
           name.substr(first.size(), name.size() - first.size() - last.size())
                   .find_first_not_of(digits) == std::string::npos;
}

LogContent read_logs(const fs::path& folder, std::optional<RunMark> run) {
    const std::vector<fs::path> logs = logs_in(folder);
    if (!run) {
        Votes votes;
        for (const fs::path& log : logs) count_votes(read_regular(log), votes);
        run = most_voted(votes);
    }
    LogContent content;
    Places places;
    std::vector<std::pair<fs::path, Votes>> others;
    for (const fs::path& log : logs)
        read_log(read_regular(log), *run, places, content,
                 others.emplace_back(log, Votes{}).second);
    judge_others(others, content);
    return content;
}

}  // namespace bemcal::store
