#include "base/disk.hpp"
#include "base/error.hpp"
#include "base/lock.hpp"
#include "support/temporary_folder.hpp"

#include <fstream>
#include <thread>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>

namespace bemcal {
namespace {

namespace fs = std::filesystem;

void write(const fs::path& path, const std::string& text) {
    std::ofstream(path) << text;
}

std::size_t n_files(const fs::path& folder) {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

ExitCode code_of(const std::function<void()>& step) {
    try {
        step();
    } catch (const UserError& error) {
        return error.exit_code();
    }
    return ExitCode::ok;
}

TEST(Disk, AFileHasOneIdUnderAllItsNames) {
    const test::TemporaryFolder folder;
    write(folder / "a", "1");
    fs::create_hard_link(folder / "a", folder / "hard");
    fs::create_symlink("a", folder / "soft");
    fs::create_symlink("nowhere", folder / "dangling");
    write(folder / "b", "1");
    EXPECT_EQ(file_id(folder / "hard"), file_id(folder / "a"));
    EXPECT_EQ(file_id(folder / "soft"), file_id(folder / "a"));
    EXPECT_NE(file_id(folder / "b"), file_id(folder / "a"));
    EXPECT_FALSE(file_id(folder / "dangling"));
    EXPECT_TRUE(is_taken(folder / "dangling"));
    EXPECT_FALSE(is_taken(folder / "nowhere"));
}

TEST(Disk, AFreshFileIsGoneUnlessItTookItsPlace) {
    const test::TemporaryFolder folder;
    {
        FreshFile fresh(folder.path(), "a");
        fresh.write("text");
        EXPECT_TRUE(is_fresh_name(fresh.path().filename().string(), "a"));
        EXPECT_EQ(n_files(folder.path()), 1U);
    }
    EXPECT_EQ(n_files(folder.path()), 0U);
    {
        FreshFile fresh(folder.path(), "a");
        fresh.write("text");
        fresh.move_to(folder / "a", Replace::no);
    }
    EXPECT_EQ(n_files(folder.path()), 1U);
    EXPECT_EQ(read_regular(folder / "a"), "text");
}

TEST(Disk, ANameThatIsTakenIsKeptUnlessItMayBeReplaced) {
    const test::TemporaryFolder folder;
    write(folder / "a", "old");
    FreshFile fresh(folder.path(), "a");
    EXPECT_EQ(code_of([&] { fresh.move_to(folder / "a", Replace::no); }),
              ExitCode::cannot_create);
    EXPECT_EQ(read_regular(folder / "a"), "old");
    replace_file(folder / "a", "new");
    EXPECT_EQ(read_regular(folder / "a"), "new");
}

TEST(Disk, ALinkIsReplacedAndWhatItNamesIsNotTouched) {
    const test::TemporaryFolder folder;
    write(folder / "victim", "precious");
    fs::create_symlink("victim", folder / "a");
    replace_file(folder / "a", "new");
    EXPECT_EQ(read_regular(folder / "victim"), "precious");
    EXPECT_FALSE(fs::is_symlink(folder / "a"));
}

TEST(Disk, AFileTakenFromUnderItsWriterIsAnError) {
    const test::TemporaryFolder folder;
    FreshFile fresh(folder.path(), "a");
    fs::remove(fresh.path());
    write(fresh.path(), "of another");
    EXPECT_NE(code_of([&] { fresh.move_to(folder / "a", Replace::yes); }), ExitCode::ok);
    EXPECT_FALSE(is_taken(folder / "a"));
}

TEST(Disk, AFullDiskKeepsTheOldFileAndLeavesNoOther) {
    const test::TemporaryFolder folder;
    ::signal(SIGXFSZ, SIG_IGN);
    write(folder / "a", "old");
    rlimit old{};
    ::getrlimit(RLIMIT_FSIZE, &old);
    const rlimit small{100, old.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &small);
    const ExitCode code =
        code_of([&] { replace_file(folder / "a", std::string(1000, 'x')); });
    ::setrlimit(RLIMIT_FSIZE, &old);
    EXPECT_EQ(code, ExitCode::io);
    EXPECT_EQ(read_regular(folder / "a"), "old");
    EXPECT_EQ(n_files(folder.path()), 1U);
}

TEST(Disk, FoldersAndPipesAreNotReadAndDoNotHang) {
    const test::TemporaryFolder folder;
    fs::create_directory(folder / "d");
    ASSERT_EQ(::mkfifo((folder / "p").c_str(), 0600), 0);
    for (const char* name : {"d", "p"})
        EXPECT_EQ(code_of([&] { read_regular(folder / name); }), ExitCode::data) << name;
    EXPECT_EQ(code_of([&] { read_regular(folder / "none"); }), ExitCode::no_input);
}

TEST(Disk, ANameThatIsTooLongIsSaidSo) {
    const test::TemporaryFolder folder;
    try {
        replace_file(folder / std::string(300, 'n'), "x");
        ADD_FAILURE();
    } catch (const UserError& error) {
        EXPECT_EQ(error.exit_code(), ExitCode::cannot_create);
        EXPECT_NE(std::string(error.what()).find("name is too long"), std::string::npos);
    }
}

TEST(Lock, IsHeldByOneAtATimeAndEndsWithItsHolder) {
    const test::TemporaryFolder folder;
    {
        Lock first(folder / "lock", O_RDWR | O_CREAT);
        EXPECT_FALSE(first.is_taken_by_another());
        EXPECT_TRUE(first.is_kept_by_disk());
        Lock second(folder / "lock", O_RDWR | O_CREAT);
        EXPECT_TRUE(second.is_taken_by_another());
        EXPECT_TRUE(Lock(folder / "lock", O_RDONLY).is_held_by_somebody());
        fs::remove(folder / "lock");
        EXPECT_FALSE(first.is_still_there());
    }
    write(folder / "lock", "");
    EXPECT_FALSE(Lock(folder / "lock", O_RDONLY).is_held_by_somebody());
    EXPECT_FALSE(Lock(folder / "none", O_RDONLY).is_held_by_somebody());
}

TEST(Lock, AMomentOfSomebodyWhoLooksIsWaitedFor) {
    const test::TemporaryFolder folder;
    auto looker = std::make_unique<Lock>(folder / "lock", O_RDWR | O_CREAT);
    EXPECT_FALSE(looker->is_taken_by_another());
    std::thread leaves([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
        looker.reset();
    });
    EXPECT_FALSE(Lock(folder / "lock", O_RDWR).is_taken_by_another());
    leaves.join();
}

TEST(Lock, FollowsNoLink) {
    const test::TemporaryFolder folder;
    write(folder / "victim", "");
    fs::create_symlink("victim", folder / "lock");
    EXPECT_FALSE(Lock(folder / "lock", O_RDWR | O_CREAT).is_open());
}

}  // namespace
}  // namespace bemcal
