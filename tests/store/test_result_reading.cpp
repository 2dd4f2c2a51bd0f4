#include "base/error.hpp"
#include "store/result_file.hpp"
#include "support/temporary_folder.hpp"

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <random>

#include <gtest/gtest.h>
#include <sys/stat.h>

namespace bemcal::store {
namespace {

ResultFile example() {
    ResultFile result;
    result.attributes = {{"program", "bemcal-batch"}, {"title", "office"}};
    result.run = {{"n_ranks", "2"}};
    result.datasets = {{"office/sa/output", {"output"}, {2}, {}, {"heating", "cooling"}},
                       {"office/sa/parameter", {"parameter"}, {3}, {}, {"a", "b", "c"}},
                       {"office/sa/total_order",
                        {"output", "parameter"},
                        {2, 3},
                        {1, 2, 3, 4, 5, 6},
                        {}}};
    return result;
}

std::string bytes_of(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// "" where it can be read.
std::string refusal_of(const std::filesystem::path& file,
                       ExitCode code = ExitCode::data) {
    try {
        read_result(file);
        return "";
    } catch (const UserError& error) {
        EXPECT_EQ(error.exit_code(), code) << error.what();
        return error.what();
    }
}

/// Changes an example in Python, `f` being the file; skipped without h5py.
class HostileResult : public testing::Test {
  protected:
    void SetUp() override {
        write_result(file_, example());
        if (std::system("/usr/bin/python3 -c 'import h5py' 2>/dev/null") != 0)
            GTEST_SKIP() << "no h5py";
    }
    std::string after(const std::string& change) const {
        std::ofstream(folder_ / "change.py") << "import h5py, numpy as np, sys\n"
                                                "texts = h5py.string_dtype()\n"
                                                "f = h5py.File(sys.argv[1], 'r+')\n"
                                                "t = f['office/sa/total_order']\n"
                                             << change << "\nf.close()\n";
        const std::string command =
            "/usr/bin/python3 " + (folder_ / "change.py").string() + " " + file_.string();
        EXPECT_EQ(std::system(command.c_str()), 0) << change;
        return refusal_of(file_);
    }
    void expect(const std::string& change, const std::string& part) const {
        EXPECT_NE(after(change).find(part), std::string::npos) << after(change);
    }

    test::TemporaryFolder folder_;
    std::filesystem::path file_ = folder_ / "a.h5";
};

TEST_F(HostileResult, AListOfTextsIsNoAttribute) {
    expect("f.attrs.create('title', ['A' * 8] * 4000, dtype=texts)",
           "a.h5: not a result of bemcal-batch: attribute title is not one text");
}
TEST_F(HostileResult, OfADatasetNeither) {
    expect("t.attrs.create('units', ['1', '2'], dtype=texts)",
           "a.h5: damaged: attribute units is not one text");
}
TEST_F(HostileResult, AttributesOfOtherTypesArePassedOver) {
    EXPECT_EQ(after("f.attrs['note'] = [1, 2, 3]\nt.attrs['mark'] = np.bytes_('x' * 5000)"
                    "\nt.attrs['CLASS'] = np.bytes_('x' * 5000)"),
              "");
}
TEST_F(HostileResult, AShapeBeyondTheFileIsRefused) {
    expect(
        "f.create_dataset('office/sa/first_order', (1 << 40, 1 << 20), 'f8',"
        " chunks=(1, 1024))",
        "dataset office/sa/first_order has shape (1099511627776, 1048576), more than "
        "the file can hold");
}
TEST_F(HostileResult, AnEmptyShapeHasNoLongSide) {
    expect("f.create_dataset('office/sa/first_order', (1 << 50, 0), 'f8')",
           "more than the file can hold");
}
TEST_F(HostileResult, PackedZerosBeyondAllMeasureAreRefused) {
    expect(
        "f.create_dataset('office/sa/first_order', data=np.zeros(20000000),"
        " compression=9)",
        "more than the file can hold");
}
TEST_F(HostileResult, APackedResultIsRead) {
    EXPECT_EQ(after("f.create_dataset('office/sa/first_order', data=np.ones((2, 3)),"
                    " chunks=(2, 3), compression=9)"),
              "");
}
TEST_F(HostileResult, OtherTypesAreRefused) {
    const std::string why =
        "dataset office/sa/first_order holds neither numbers nor "
        "texts of variable length";
    const std::string make = "f.create_dataset('office/sa/first_order', ";
    for (const char* values :
         {"data=np.zeros(3, dtype=[('a', 'f8'), ('b', 'i4')])",
          "data=np.array([b'abc', b'de'])", "data=np.zeros(2, dtype='V7')",
          "(3,), dtype=h5py.vlen_dtype(float)", "data=f.ref, dtype=h5py.ref_dtype"}) {
        write_result(file_, example());
        expect(make + values + ")", why);
    }
}
TEST_F(HostileResult, NoShapeAtAllIsRefused) {
    expect("f['office/sa/first_order'] = h5py.Empty('f8')",
           "dataset office/sa/first_order has no shape");
}
TEST_F(HostileResult, TextsOfNullAreEmpty) {
    EXPECT_EQ(after("f.create_dataset('office/sa/unit', (4,), dtype=texts)"), "");
}
TEST_F(HostileResult, CirclesOfGroupsAreFollowedOnce) {
    EXPECT_EQ(
        after("f['office/again'] = f['office']\nf['soft'] = h5py.SoftLink('/soft')"), "");
}
TEST_F(HostileResult, OtherFilesAreNotFollowed) {
    expect(
        "import shutil; shutil.copy(sys.argv[1], sys.argv[1] + '.other')\n"
        "del f['run']; f['run'] = h5py.ExternalLink(sys.argv[1] + '.other', '/run')",
        "not a result of bemcal-batch: open run");
}
TEST_F(HostileResult, NorValuesInOtherFiles) {
    expect(
        "f.create_dataset('office/sa/first_order', (3,), 'f8',"
        " external=[('/etc/passwd', 0, 24)])",
        "dataset office/sa/first_order lies in another file");
    write_result(file_, example());
    expect(
        "v = h5py.VirtualLayout((3,), 'f8')\n"
        "v[:] = h5py.VirtualSource('/tmp/other.h5', 'x', (3,))\n"
        "f.create_virtual_dataset('office/sa/first_order', v)",
        "dataset office/sa/first_order lies in another file");
}
TEST_F(HostileResult, ListsOfDimensionsMayBeOfAnyKind) {
    for (const char* values : {"np.zeros(50, dtype='f8')", "np.bytes_('x' * 900)",
                               "np.zeros(2, dtype=[('a', 'f8', 40)])"}) {
        write_result(file_, example());
        expect(
            std::string("del t.attrs['DIMENSION_LIST']; t.attrs['DIMENSION_LIST'] = ") +
                values,
            "dataset office/sa/total_order has damaged dimensions");
    }
}

TEST(ResultReading, WhateverBytesChangeItIsReadOrRefused) {
    const test::TemporaryFolder folder;
    write_result(folder / "a.h5", example());
    const std::string good = bytes_of(folder / "a.h5");
    std::mt19937 random(1);
    const auto below = [&](std::size_t n) { return random() % n; };
    for (int k = 0; k < 120; ++k) {
        std::string bytes = good;
        for (std::size_t n = 1 + below(8); n > 0; --n)
            bytes[below(bytes.size())] = static_cast<char>(below(256));
        if (k % 10 == 0) bytes.resize(below(bytes.size()));
        std::ofstream(folder / "b.h5", std::ios::binary) << bytes;
        refusal_of(folder / "b.h5");
    }
}

TEST(ResultReading, APipeIsNoResultAndNotWaitedFor) {
    const test::TemporaryFolder folder;
    ASSERT_EQ(::mkfifo((folder / "a.h5").c_str(), 0600), 0);
    EXPECT_NE(refusal_of(folder / "a.h5", ExitCode::no_input).find("is no regular file"),
              std::string::npos);
}

}  // namespace
}  // namespace bemcal::store
