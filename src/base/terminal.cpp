/// Prints through C's streams, with what is not fit for a terminal made visible.
/// Source: ECMA-48 (control sequences), Unicode (bidirectional controls), RFC 3629
/// (UTF-8). Characters that merely look alike are let through.
#include "base/terminal.hpp"

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <new>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

namespace bemcal {
namespace {

std::atomic<bool> is_lost = false, is_reader_gone = false;

struct Character {
    std::uint32_t code = 0;
    std::size_t bytes = 0;  ///< 0: no UTF-8 begins there
};

struct Lead {
    unsigned char mask, mark;
    std::uint32_t least;  ///< of that many bytes; less is overlong
};
constexpr Lead leads[] = {
    {0x80, 0x00, 0}, {0xe0, 0xc0, 0x80}, {0xf0, 0xe0, 0x800}, {0xf8, 0xf0, 0x10000}};

Character character_at(std::string_view text) {
    const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[k]); };
    for (std::size_t more = 0; more < std::size(leads); ++more) {
        const Lead& lead = leads[more];
        if ((byte(0) & lead.mask) != lead.mark) continue;
        if (text.size() <= more) return {};
        std::uint32_t code = byte(0) & static_cast<unsigned char>(~lead.mask);
        for (std::size_t k = 1; k <= more; ++k) {
            if ((byte(k) & 0xc0) != 0x80) return {};
            code = code << 6 | (byte(k) & 0x3fU);
        }
        const bool is_one =
            code >= lead.least && code <= 0x10ffff && (code < 0xd800 || code > 0xdfff);
        return is_one ? Character{code, more + 1} : Character{};
    }
    return {};
}

struct Range {
    std::uint32_t first, last;
};
/// C0 and C1, marks of direction, separators of lines, the byte order mark.
constexpr Range harmful[] = {{0x00, 0x1f},     {0x7f, 0x9f},     {0x200e, 0x200f},
                             {0x2028, 0x202e}, {0x2066, 0x2069}, {0xfeff, 0xfeff}};

bool is_harmful(std::uint32_t code) {
    for (const Range& range : harmful)
        if (code >= range.first && code <= range.last) return true;
    return false;
}

std::string escaped(std::uint32_t code) {
    if (code == '\n') return "\\n";
    if (code == '\t') return "\\t";
    return code < 0x100 ? fmt::format("\\x{:02x}", code) : fmt::format("\\u{:04x}", code);
}

std::string cleaned(std::string_view text, std::string_view kept) {
    std::string out;
    out.reserve(text.size());
    while (!text.empty()) {
        const Character next = character_at(text);
        const std::size_t n = next.bytes == 0 ? 1 : next.bytes;
        if (next.bytes == 0)
            out += escaped(static_cast<unsigned char>(text[0]));
        else if (is_harmful(next.code) && kept.find(text[0]) == std::string_view::npos)
            out += escaped(next.code);
        else
            out += text.substr(0, n);
        text.remove_prefix(n);
    }
    return out;
}

}  // namespace

std::string printable(std::string_view text) {
    return cleaned(text, "\n\t");
}

std::string in_one_line(std::string_view text) {
    return cleaned(text, "");
}

void open_standard_streams() {
    // Not ignored, which a program that we start would inherit.
    std::signal(SIGPIPE, [](int) {});
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        if (::fcntl(stream, F_GETFD) == -1)  // the lowest free number is this one
            if (::open(stream == STDIN_FILENO ? "/dev/null" : "/dev/full", O_RDWR) < 0)
                is_lost = stream != STDIN_FILENO || is_lost;
}

void print_raw(std::FILE* stream, std::string_view text) noexcept {
    errno = 0;
    const bool is_written =
        std::fwrite(text.data(), 1, text.size(), stream) == text.size();
    if (std::fflush(stream) != 0 || !is_written) {
        if (errno == EPIPE) is_reader_gone = true;
        is_lost = true;
    }
    std::clearerr(stream);
}

void print(std::FILE* stream, std::string_view text) noexcept {
    try {
        print_raw(stream, printable(text));
    } catch (const std::bad_alloc&) {
        is_lost = true;
    }
}

bool is_output_lost() noexcept {
    return is_lost;
}

bool has_reader_gone() noexcept {
    return is_reader_gone;
}

}  // namespace bemcal
