/// Tells text from packed and binary files by their first bytes, brings Latin-1 to UTF-8,
/// and cuts a text into lines.
/// Source: the formats' own signatures (as of file(1)); WHATWG, Encoding, windows-1252.
/// Leaves out other code pages: text that is no UTF-8 is taken for Windows-1252. UTF-16
/// is named only.
#include "input/data_text.hpp"

#include "base/error.hpp"
#include "base/lower_case.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

#include <fmt/format.h>

namespace bemcal::input {

namespace {

struct Kind {
    std::size_t at;
    std::string_view magic;
    const char* is;
    const char* advice;
};
using namespace std::string_view_literals;
constexpr const char* unpack = "unpack it and name the file that was in it";
constexpr const char* save_as = "open it there and save the table as CSV in UTF-8";
constexpr const char* to_utf8 =
    "save it as UTF-8, or convert it: iconv -f UTF-16 -t UTF-8 OLD > NEW";
constexpr Kind kinds[] = {
    {0, "\xD0\xCF\x11\xE0"sv, "a workbook (xls)", save_as},
    {0, "\x1F\x8B"sv, "gzipped twice", "unpack it once with gunzip"},
    {0, "BZh"sv, "a bzip2 file", unpack},
    {0,
     "\xFD"
     "7zXZ\0"sv,
     "an xz file", unpack},
    {0, "\x28\xB5\x2F\xFD"sv, "a zstd file", unpack},
    {0, "7z\xBC\xAF"sv, "a 7z archive", unpack},
    {0, "Rar!"sv, "a rar archive", unpack},
    {257, "ustar"sv, "a tar archive", unpack},
    {0, "%PDF"sv, "a PDF document", "ask for the table as CSV"},
    {0, "SQLite format 3"sv, "an SQLite data base", "export the table as CSV"},
    {0, "\x89HDF"sv, "an HDF5 or netCDF file", "write its series to a CSV file"},
    {0, "CDF\x01"sv, "a netCDF file", "write its series to a CSV file"},
    {0, "PAR1"sv, "a Parquet file", "write its table to a CSV file"},
    {0, "\xFF\xFE"sv, "UTF-16 (\"Unicode\" of Windows)", to_utf8},
    {0, "\xFE\xFF"sv, "UTF-16, the high byte first", to_utf8},
};

[[noreturn]] void fail_kind(const std::string& path, const std::string& is,
                            const char* advice) {
    throw UserError(ExitCode::data,
                    fmt::format("{}: is {}; expected a text file: {}", path, is, advice));
}

/// The name of the first file in a zip archive (its local header), where it is plain.
std::string first_member(std::string_view bytes) {
    if (bytes.size() < 30) return {};
    const std::size_t n = static_cast<unsigned char>(bytes[26]) +
                          256U * static_cast<unsigned char>(bytes[27]);
    const std::string name(bytes.substr(30, std::min<std::size_t>(n, 100)));
    const bool plain =
        std::ranges::all_of(name, [](char c) { return c >= ' ' && c <= '~'; });
    return plain ? name : "";
}

bool is_workbook(std::string_view bytes, const std::string& path) {
    for (const char* part : {"[Content_Types].xml", "xl/", "opendocument.spreadsheet"})
        if (bytes.find(part) != std::string_view::npos) return true;
    return path.ends_with(".xlsx") || path.ends_with(".xlsm") || path.ends_with(".ods");
}

void refuse_zip(std::string_view bytes, const std::string& path) {
    if (!bytes.starts_with("PK\x03\x04")) return;
    if (is_workbook(bytes, path))
        fail_kind(path, "a workbook (xlsx or ods, a zip archive)", save_as);
    const std::string member = first_member(bytes);
    fail_kind(path,
              "a zip archive" + (member.empty() ? "" : fmt::format(" with {}", member)),
              unpack);
}

/// Letters of ASCII in UTF-16 without its mark: a zero at every second place.
void refuse_unmarked_utf16(std::string_view bytes, const std::string& path) {
    std::array<std::size_t, 2> zeros{};
    const std::size_t n = std::min<std::size_t>(bytes.size(), 400);
    for (std::size_t k = 0; k < n; ++k) zeros[k % 2] += bytes[k] == '\0';
    if (n >= 8 && 5 * std::max(zeros[0], zeros[1]) > 2 * n)
        fail_kind(path, "UTF-16 without its mark", to_utf8);
}

void refuse_markup(std::string_view bytes, const std::string& path) {
    const std::size_t first = bytes.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
    if (first == std::string_view::npos) return;
    const std::string begin = lower_case(bytes.substr(first, 20));
    if (begin.starts_with("<!doctype html") || begin.starts_with("<html"))
        fail_kind(path, "a web page",
                  "download the file itself (an EPW file begins with LOCATION, a CSV "
                  "file with the names of its columns)");
    if (begin.starts_with("<?xml"))
        fail_kind(path, "an XML document", "ask for the table as CSV");
    if (begin.starts_with("{")) fail_kind(path, "JSON", "ask for the table as CSV");
}

/// How many bytes follow the first one of a letter in UTF-8; -1 = it begins none.
int n_following(unsigned char first) {
    if (first < 0x80) return 0;
    if (first >= 0xC2 && first <= 0xDF) return 1;
    if (first >= 0xE0 && first <= 0xEF) return 2;
    if (first >= 0xF0 && first <= 0xF4) return 3;
    return -1;
}

bool is_following(char c) {
    return (static_cast<unsigned char>(c) & 0xC0) == 0x80;
}

/// What Windows-1252 has at 0x80 to 0x9F; 0 = nothing.
constexpr std::uint16_t windows_letters[32] = {
    0x20AC, 0,      0x201A, 0x0192, 0x201E, 0x2026, 0x2020, 0x2021,
    0x02C6, 0x2030, 0x0160, 0x2039, 0x0152, 0,      0x017D, 0,
    0,      0x2018, 0x2019, 0x201C, 0x201D, 0x2022, 0x2013, 0x2014,
    0x02DC, 0x2122, 0x0161, 0x203A, 0x0153, 0,      0x017E, 0x0178};

void append_letter(std::string& text, unsigned code) {
    if (code < 0x80) {
        text += static_cast<char>(code);
    } else if (code < 0x800) {
        text += static_cast<char>(0xC0 | (code >> 6));
        text += static_cast<char>(0x80 | (code & 0x3F));
    } else {
        text += static_cast<char>(0xE0 | (code >> 12));
        text += static_cast<char>(0x80 | ((code >> 6) & 0x3F));
        text += static_cast<char>(0x80 | (code & 0x3F));
    }
}

}  // namespace

void refuse_other_kinds(std::string_view bytes, const std::string& path) {
    refuse_zip(bytes, path);
    for (const Kind& kind : kinds)
        if (bytes.size() >= kind.at && bytes.substr(kind.at).starts_with(kind.magic))
            fail_kind(path, kind.is, kind.advice);
    refuse_unmarked_utf16(bytes, path);
    refuse_markup(bytes, path);
}

bool is_utf8(std::string_view text) {
    for (std::size_t k = 0; k < text.size();) {
        const int n = n_following(static_cast<unsigned char>(text[k]));
        if (n < 0) return false;
        const std::string_view following =
            text.substr(k + 1, static_cast<std::size_t>(n));
        if (std::ssize(following) != n || !std::ranges::all_of(following, is_following))
            return false;
        k += static_cast<std::size_t>(n) + 1;
    }
    return true;
}

std::string from_windows_1252(std::string_view text) {
    std::string made;
    made.reserve(text.size() + text.size() / 8);
    for (const char c : text) {
        unsigned code = static_cast<unsigned char>(c);
        if (code >= 0x80 && code < 0xA0 && windows_letters[code - 0x80] != 0)
            code = windows_letters[code - 0x80];
        append_letter(made, code);
    }
    return made;
}

bool next_line(std::string_view& rest, std::string_view& line) {
    if (rest.empty()) return false;
    std::size_t end = 0;
    while (end < rest.size() && rest[end] != '\n' && rest[end] != '\r') ++end;
    line = rest.substr(0, end);
    rest.remove_prefix(end);
    const bool both = rest.starts_with("\r\n");
    rest.remove_prefix(std::min<std::size_t>(both ? 2 : 1, rest.size()));
    return true;
}

std::string_view trimmed(std::string_view text) {
    const auto is_blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
    while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
    return text;
}

}  // namespace bemcal::input
