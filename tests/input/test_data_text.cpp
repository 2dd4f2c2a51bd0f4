/// What files are, by their bytes.
#include "base/error.hpp"
#include "input/data_text.hpp"
#include "input/input_files.hpp"
#include "support/temporary_folder.hpp"

#include <string>
#include <utility>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

namespace bemcal::job {
namespace {

using namespace std::string_literals;

std::string complaint(const std::string& bytes, const std::string& path = "x") {
    try {
        input::refuse_other_kinds(bytes, path);
    } catch (const UserError& error) {
        EXPECT_EQ(error.exit_code(), ExitCode::data);
        return error.what();
    }
    return "no complaint";
}

std::string zip_with(const std::string& member) {
    std::string bytes = "PK\x03\x04"s + std::string(26, '\0') + member;
    bytes[26] = static_cast<char>(member.size());
    return bytes;
}

TEST(DataText, PackedFilesAreNamed) {
    EXPECT_EQ(
        complaint(zip_with("w.epw")),
        "x: is a zip archive with w.epw; expected a text file: unpack it and name the "
        "file that was in it");
    EXPECT_EQ(
        complaint(zip_with("[Content_Types].xml")),
        "x: is a workbook (xlsx or ods, a zip archive); expected a text file: open it "
        "there and save the table as CSV in UTF-8");
    EXPECT_NE(complaint(zip_with("a.csv"), "m.xlsx").find("is a workbook"),
              std::string::npos);
    const std::pair<std::string, const char*> others[] = {
        {"\xD0\xCF\x11\xE0\xA1\xB1"s, "a workbook (xls)"},
        {"\x1F\x8B\x08"s, "gzipped twice"},
        {"BZh91AY"s, "bzip2"},
        {"7z\xBC\xAF\x27\x1C"s, "7z"},
        {"%PDF-1.4"s, "PDF"},
        {std::string(257, 'a') + "ustar"s, "a tar archive"},
        {"PAR1"s, "Parquet"}};
    for (const auto& [bytes, is] : others)
        EXPECT_NE(complaint(bytes).find(is), std::string::npos) << is;
}

TEST(DataText, WebPagesAndTheLikeAreNamed) {
    EXPECT_NE(complaint("\n<!DOCTYPE html>\n<html>").find("is a web page"),
              std::string::npos);
    EXPECT_NE(complaint("<HTML><body>404").find("LOCATION"), std::string::npos);
    EXPECT_NE(complaint("<?xml version=\"1.0\"?>").find("XML"), std::string::npos);
    EXPECT_NE(complaint("{\"inputs\": 1}").find("JSON"), std::string::npos);
}

TEST(DataText, Utf16IsNamedWithAndWithoutItsMark) {
    const std::string letters = "t\0i\0m\0e\0;\0k\0w\0h\0"s;
    EXPECT_NE(complaint("\xFF\xFE"s + letters).find("is UTF-16"), std::string::npos);
    EXPECT_NE(complaint("\xFE\xFF"s + '\0' + letters).find("is UTF-16"),
              std::string::npos);
    EXPECT_NE(complaint(letters).find("is UTF-16 without its mark"), std::string::npos);
}

TEST(DataText, TextOfAnyLanguageIsText) {
    for (const char* text : {"time,kwh\n", "Z\xC3\xA4hler\n", "Z\xE4hler\n", "a", ""})
        EXPECT_EQ(complaint(text), "no complaint");
}

TEST(DataText, Utf8IsToldFromWindows1252) {
    EXPECT_TRUE(input::is_utf8("Z\xC3\xA4hler [\xC2\xB0]"));
    EXPECT_TRUE(input::is_utf8("\xE2\x82\xAC \xF0\x9F\x98\x80"));
    for (const char* text : {"Z\xE4hler", "\xC3", "\xC0\x80", "\xE2\x82", "\x80"})
        EXPECT_FALSE(input::is_utf8(text)) << text;
    EXPECT_EQ(input::from_windows_1252("Z\xE4hler \x80 \x93"),
              "Z\xC3\xA4hler \xE2\x82\xAC \xE2\x80\x9C");
}

TEST(DataText, LinesEndInEveryWay) {
    std::string_view rest = "a\nb\r\nc\rd\r\r\n", line;
    std::string all;
    while (input::next_line(rest, line)) all += fmt::format("[{}]", line);
    EXPECT_EQ(all, "[a][b][c][d][]");
}

TEST(InputFiles, WhatIsNoFileIsNamedAndNotWaitedFor) {
    const test::TemporaryFolder folder;
    ASSERT_EQ(::mkfifo((folder / "pipe.csv").c_str(), 0600), 0);
    const std::pair<std::string, const char*> others[] = {
        {folder.path().string(), "a folder"},
        {(folder / "pipe.csv").string(), "a pipe"},
        {"/dev/zero", "a device"}};
    for (const auto& [path, what] : others) try {
            input::read_bytes(path);
            ADD_FAILURE() << path;
        } catch (const UserError& error) {
            EXPECT_EQ(error.exit_code(), ExitCode::no_input);
            EXPECT_EQ(error.what(),
                      fmt::format("{}: is {}; expected a file", path, what));
        }
}

TEST(InputFiles, LatinColumnsAreNamedInUtf8) {
    input::InputFiles files([](const std::filesystem::path&) {
        return "Zeit;Z\xE4hler (kWh)\n2021-01-01;5\n"s;
    });
    input::CsvForm form;
    form.names = {"Z\xC3\xA4hler (kWh)"};
    EXPECT_EQ(files.csv("x.csv", "", form).column(form.names[0]), 1U);
    EXPECT_EQ(files.text("x.csv").find('\xE4'), 6U) << "the bytes stay as they are";
}

TEST(InputFiles, MetersThatReadOtherColumnsShareATable) {
    input::InputFiles files([](const std::filesystem::path&) {
        return "Owner,A\ntime,a,b\n2021-01-01 00:00,5,6\n"s;
    });
    input::CsvForm of_a, of_b, skips;
    of_a.names = {"a"};
    of_b.names = skips.names = {"b"};
    skips.skip_lines = {1};
    EXPECT_EQ(&files.csv("x.csv", "", of_a), &files.csv("x.csv", "", of_b));
    EXPECT_NE(&files.csv("x.csv", "", of_b), &files.csv("x.csv", "", skips));
}

}  // namespace
}  // namespace bemcal::job
