#include "external/folder.hpp"
#include "external/process.hpp"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <thread>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

namespace bemcal::external {
namespace {

Command shell(const Folder& folder, const std::string& text, double limit_s = 20) {
    return {"/bin/sh",
            {"sh", "-c", text},
            environment_for_children(),
            folder.path(),
            "out",
            "err",
            limit_s};
}

TEST(Process, RunsInItsFolderAndWritesWhatItPrints) {
    const Folder folder;
    const Ended ended =
        run_command(shell(folder, "pwd; echo no >&2; cat; touch made; exit 3"));
    EXPECT_EQ(ended.how, Ending::exited);
    EXPECT_EQ(ended.number, 3);
    EXPECT_EQ(folder.text("out"),
              std::filesystem::canonical(folder.path()).string() + "\n");
    EXPECT_EQ(folder.text("err"), "no\n");
    EXPECT_TRUE(std::filesystem::exists(folder / "made"));
}

TEST(Process, TellsASignalFromAnExit) {
    const Folder folder;
    const Ended ended = run_command(shell(folder, "kill -SEGV $$"));
    EXPECT_EQ(ended.how, Ending::killed);
    EXPECT_EQ(ended.number, SIGSEGV);
}

TEST(Process, WhatIsNoProgramDoesNotStart) {
    const Folder folder;
    Command command = shell(folder, "true");
    command.program = folder / "absent";
    EXPECT_EQ(run_command(command).how, Ending::not_started);
    EXPECT_EQ(run_command(command).number, ENOENT);
    command.program = folder.write("text", "no program");
    EXPECT_EQ(run_command(command).number, EACCES);
}

/// An ended one that nobody has waited for has the state Z.
bool is_alive(const std::string& id) {
    std::ifstream in("/proc/" + std::to_string(std::stoi(id)) + "/stat");
    std::string number, name, state;
    return (in >> number >> name >> state) && state != "Z";
}

/// Whether the process whose number stands in the file goes within ten seconds.
bool goes(const Folder& folder, const std::string& file) {
    const std::string id = folder.text(file);
    for (int k = 0; k < 1000 && is_alive(id); ++k)
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return !id.empty() && !is_alive(id);
}

TEST(Process, AtTheTimeLimitItEndsWithAllThatItStarted) {
    const Folder folder;
    const Ended ended =
        run_command(shell(folder, "sleep 600 & echo $! > child; wait", 0.3));
    EXPECT_EQ(ended.how, Ending::time_limit);
    EXPECT_TRUE(goes(folder, "child"));
}

TEST(Process, WhatDoesNotHeedTheFirstSignalIsKilled) {
    const Folder folder;
    const Ended ended = run_command(
        shell(folder, "trap '' TERM; echo $$ > child; while :; do sleep 1; done", 0.3));
    EXPECT_EQ(ended.how, Ending::time_limit);
    EXPECT_TRUE(goes(folder, "child"));
}

TEST(Process, WhatItLeavesBehindGoesWithIt) {
    const Folder folder;
    const Ended ended = run_command(shell(folder, "sleep 600 & echo $! > child"));
    EXPECT_EQ(ended.how, Ending::exited);
    EXPECT_EQ(ended.number, 0);
    EXPECT_TRUE(goes(folder, "child"));
}

/// In a session of its own, whose parent has gone.
constexpr const char* daemon_text =
    "setsid sh -c 'setsid sleep 600 & echo $! > child; sleep 600' & "
    "while [ ! -s child ]; do sleep 0.01; done; ";

TEST(Process, ASessionOfItsOwnGoesWithItToo) {
    const Folder folder;
    EXPECT_EQ(run_command(shell(folder, daemon_text)).how, Ending::exited);
    EXPECT_TRUE(goes(folder, "child"));
}

TEST(Process, AndAtTheTimeLimit) {
    const Folder folder;
    EXPECT_EQ(run_command(shell(folder, std::string(daemon_text) + "sleep 600", 0.5)).how,
              Ending::time_limit);
    EXPECT_TRUE(goes(folder, "child"));
}

TEST(Process, WhatKillsItsOwnGroupDoesNotReachUs) {
    const Folder folder;
    const Ended ended = run_command(shell(folder, "kill -TERM 0; sleep 600"));
    EXPECT_EQ(ended.how, Ending::killed);
    EXPECT_EQ(ended.number, SIGTERM);
}

TEST(Process, WhatKillsItsParentLeavesNothingBehind) {
    const Folder folder;
    const Ended ended = run_command(
        shell(folder, std::string(daemon_text) + "kill -KILL $PPID; sleep 600", 20));
    EXPECT_EQ(ended.how, Ending::killed);
    EXPECT_EQ(ended.number, SIGKILL);
    EXPECT_TRUE(goes(folder, "child"));
}

TEST(Process, WhatStopsItsParentEndsAtTheTimeLimit) {
    const Folder folder;
    const Ended ended = run_command(
        shell(folder, std::string(daemon_text) + "kill -STOP $PPID; exit 0", 0.5));
    EXPECT_EQ(ended.how, Ending::time_limit);
    EXPECT_TRUE(goes(folder, "child"));
}

TEST(Process, ItsFilesEndAtTheirLimit) {
    const Folder folder;
    Command command = shell(folder, "exec dd if=/dev/zero of=large bs=4096 count=100");
    command.output_limit = 100000;
    const Ended ended = run_command(command);
    EXPECT_EQ(ended.how, Ending::killed);
    EXPECT_EQ(ended.number, SIGXFSZ);
    EXPECT_LE(std::filesystem::file_size(folder / "large"), 100000U);
}

/// Waits until the file says something.
std::string first_text(const Folder& folder, const std::string& file) {
    while (folder.text(file).empty())
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    return folder.text(file);
}

TEST(Process, EverythingEndsWhenWeAreKilled) {
    const Folder folder;
    const pid_t we = ::fork();
    if (we == 0) {
        run_command(shell(folder, std::string(daemon_text) + "echo $$ > own; sleep 600"));
        ::_exit(0);
    }
    first_text(folder, "own");
    ::kill(we, SIGKILL);
    ::waitpid(we, nullptr, 0);
    EXPECT_TRUE(goes(folder, "own"));
    EXPECT_TRUE(goes(folder, "child"));
}

TEST(Process, StandardStreamsThatAreClosedDoNotStandInTheWay) {
    const Folder folder;
    const pid_t we = ::fork();
    if (we == 0) {
        for (const int stream : {0, 1, 2}) ::close(stream);
        const Ended ended = run_command(shell(folder, "echo yes; exit 5"));
        ::_exit(ended.how == Ending::exited ? ended.number : 1);
    }
    int status = 0;
    ::waitpid(we, &status, 0);
    EXPECT_EQ(WEXITSTATUS(status), 5);
    EXPECT_EQ(folder.text("out"), "yes\n");
}

/// The last one: nothing starts after it.
TEST(ProcessAtTheEnd, AllThatRunIsEndedAndNoMoreStarts) {
    const Folder folder;
    std::jthread running(
        [&] { run_command(shell(folder, "echo $$ > child; sleep 600", 500)); });
    while (!folder.text("child").ends_with('\n'))
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    const std::string id = folder.text("child");
    end_commands();
    running.join();
    EXPECT_FALSE(is_alive(id));
    EXPECT_EQ(run_command(shell(folder, "true")).how, Ending::not_started);
}

TEST(Process, InheritsNoFileOfOurs) {
    const Folder folder;
    const int open_file = ::open((folder / "ours").c_str(), O_CREAT | O_WRONLY, 0600);
    ASSERT_GT(open_file, 2);
    run_command(shell(folder, "ls /proc/self/fd"));
    ::close(open_file);
    // ls has a file of its own: the folder that it lists.
    EXPECT_EQ(folder.text("out"), "0\n1\n2\n3\n");
}

TEST(Process, DoesNotTakeItselfForOneOfOurRanks) {
    ::setenv("OMPI_COMM_WORLD_RANK", "1", 1);
    ::setenv("PMIX_RANK", "1", 1);
    ::setenv("OMP_NUM_THREADS", "8", 1);
    ::setenv("BEMCAL_OF_THE_USER", "kept", 1);
    const auto variables = environment_for_children();
    const auto has = [&](const char* text) {
        return std::ranges::any_of(
            variables, [&](const std::string& each) { return each.starts_with(text); });
    };
    EXPECT_FALSE(has("OMPI_COMM_WORLD_RANK"));
    EXPECT_FALSE(has("PMIX_RANK"));
    EXPECT_FALSE(has("OMP_NUM_THREADS=8"));
    EXPECT_TRUE(has("OMP_NUM_THREADS=1"));
    EXPECT_TRUE(has("BEMCAL_OF_THE_USER=kept"));
    ::unsetenv("OMPI_COMM_WORLD_RANK");
    ::unsetenv("PMIX_RANK");
}

TEST(Process, FindsProgramsByPathAndOnPath) {
    const Folder folder;
    folder.write("text", "no program");
    const auto program = folder.write_program("run", "#!/bin/sh\n");
    EXPECT_EQ(find_program("./run", folder.path()).filename(), "run");
    EXPECT_EQ(find_program(program.string(), "/"), program);
    EXPECT_TRUE(find_program("./text", folder.path()).empty());
    EXPECT_TRUE(find_program("run", folder.path()).empty());
    EXPECT_TRUE(find_program("sh", "/").is_absolute());
}

}  // namespace
}  // namespace bemcal::external
