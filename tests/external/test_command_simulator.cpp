#include "external/command_simulator.hpp"
#include "external/folder.hpp"
#include "external/process.hpp"

#include <cmath>
#include <thread>

#include <gtest/gtest.h>

namespace bemcal::external {
namespace {

const std::vector<std::string> names{"a", "b"};

physics::Parameter parameter(const std::string& name) {
    physics::Parameter made;
    made.name = name;
    return made;
}

/// A shell script that reads "in" (the numbers a and b in two lines) and is to write
/// "out.csv"; it knows them as $a and $b.
CommandOptions script(const Folder& folder, const std::string& text) {
    folder.write("run.sh", "{ read a; read b; } < in\n" + text);
    CommandOptions options;
    options.parameters = {parameter("a"), parameter("b")};
    OutputRule sum;
    sum.name = "sum";
    sum.file = "out.csv";
    sum.column = "sum";
    options.outputs = {sum};
    options.inputs.push_back({"in", TextTemplate("@a@\n@b@\n", "in", names)});
    options.links = {folder / "run.sh"};
    options.program = "/bin/sh";
    for (const char* word : {"sh", "run.sh"})
        options.arguments.emplace_back(word, "job", names);
    options.time_limit_s = 20;
    options.folder = folder / "points";
    return options;
}

constexpr const char* adds = "echo sum > out.csv; expr $a + $b >> out.csv\n";

struct Answers {
    Matrix values;
    std::vector<std::string> failures;
};

Answers answers_of(const CommandOptions& options, std::vector<double> points) {
    Matrix matrix(points.size() / 2, 2);
    matrix.values = std::move(points);
    Answers answers;
    make_command_simulator(options)->evaluate(matrix, answers.values, answers.failures);
    return answers;
}

/// The reason without the name of the kept folder.
std::string reason(const CommandOptions& options) {
    const std::string text = answers_of(options, {1, 2}).failures.at(0);
    return text.substr(0, text.find(" (in point-"));
}

TEST(CommandSimulator, AnswersEveryPoint) {
    const Folder folder;
    const Answers answers = answers_of(script(folder, adds), {1, 2, 30, 4, 5, 5});
    EXPECT_EQ(answers.values.values, (std::vector<double>{3, 34, 10}));
    EXPECT_EQ(answers.failures, (std::vector<std::string>(3)));
    EXPECT_EQ(folder.n_files(), 1u);  // the script
}

TEST(CommandSimulator, ReadsWhatIsPrinted) {
    const Folder folder;
    CommandOptions options = script(folder, "echo the sum is `expr $a + $b`\n");
    options.outputs[0].file = standard_output;
    options.outputs[0].column.clear();
    options.outputs[0].pattern = "sum is ([0-9]+)";
    EXPECT_EQ(answers_of(options, {1, 2}).values(0, 0), 3);
}

TEST(CommandSimulator, NumbersMayStandInTheCommand) {
    const Folder folder;
    CommandOptions options =
        script(folder, "echo sum > out.csv; expr $1 + $b >> out.csv\n");
    options.arguments.emplace_back("@a@", "job", names);
    EXPECT_EQ(answers_of(options, {7, 2}).values(0, 0), 9);
}

TEST(CommandSimulator, OneFailureLeavesTheOtherPoints) {
    const Folder folder;
    const Answers answers =
        answers_of(script(folder, "if [ $a = 2 ]; then echo a is 2 >&2; exit 4; fi\n" +
                                      std::string(adds)),
                   {1, 1, 2, 1, 3, 1});
    EXPECT_EQ(answers.values(0, 0), 2);
    EXPECT_TRUE(std::isnan(answers.values(1, 0)));
    EXPECT_EQ(answers.values(2, 0), 4);
    EXPECT_EQ(answers.failures[0], "");
    EXPECT_TRUE(answers.failures[1].starts_with("exit code 4: a is 2 (in point-"))
        << answers.failures[1];
}

TEST(CommandSimulator, EveryWayToFailHasItsReason) {
    const Folder folder;
    EXPECT_EQ(reason(script(folder, "echo 'bad\x01 thing\r' >&2; exit 1")),
              "exit code 1: bad? thing ");
    EXPECT_EQ(reason(script(folder, "exit 2")), "exit code 2");
    EXPECT_EQ(reason(script(folder, "kill -KILL $$")), "ended by signal 9 (Killed)");
    EXPECT_EQ(reason(script(folder, "true")), "no sum: out.csv: it has not been written");
    EXPECT_EQ(reason(script(folder, "printf 'sum\\nmany\\n' > out.csv")),
              "no sum: out.csv: line 2 of the column \"sum\": \"many\" is no number");
    CommandOptions hangs = script(folder, "sleep 600");
    hangs.time_limit_s = 0.2;
    EXPECT_EQ(reason(hangs), "not done at its time limit of 0.2 s");
    CommandOptions absent = script(folder, "true");
    absent.program = folder / "absent";
    EXPECT_EQ(reason(absent), "cannot be started: No such file or directory");
    CommandOptions no_folder = script(folder, "true");
    no_folder.folder = folder / "run.sh" / "points";
    EXPECT_EQ(reason(no_folder), "its folder cannot be made: Not a directory");
}

TEST(CommandSimulator, APipeADeviceOrALinkIsNoOutputAndNotWaitedFor) {
    const Folder folder;
    EXPECT_EQ(reason(script(folder, "mkfifo out.csv")),
              "no sum: out.csv: is no regular file");
    EXPECT_EQ(reason(script(folder, "mkdir out.csv")),
              "no sum: out.csv: is no regular file");
    EXPECT_EQ(reason(script(folder, "ln -s /dev/zero out.csv")),
              "no sum: out.csv: is a link");
    EXPECT_EQ(reason(script(folder, "rm stderr.txt; mkfifo stderr.txt; exit 3")),
              "exit code 3");
}

TEST(CommandSimulator, AnOutputHasALimit) {
    const Folder folder;
    CommandOptions options =
        script(folder, "exec dd if=/dev/zero of=out.csv bs=4096 count=100");
    options.output_limit = 2e5;
    EXPECT_TRUE(
        reason(options).starts_with("ended as a file reached output_limit = 0.2 MB"))
        << reason(options);
}

TEST(CommandSimulator, AReasonDoesNotTellWhereItRan) {
    const Folder folder;
    EXPECT_EQ(reason(script(folder, "echo $PWD/in is odd >&2; exit 1")),
              "exit code 1: in is odd");
}

TEST(CommandSimulator, KeepsFoldersAsWanted) {
    const Folder folder;
    const auto n_kept = [&](Keep keep, const std::string& text) {
        CommandOptions options = script(folder, text);
        options.keep = keep;
        options.folder = folder / "kept";
        answers_of(options, {1, 2});
        std::size_t n = 0;
        if (!std::filesystem::exists(options.folder)) return n;
        for (const auto& each : std::filesystem::directory_iterator(options.folder)) {
            EXPECT_TRUE(std::filesystem::exists(each.path() / "in"));
            ++n;
        }
        std::filesystem::remove_all(options.folder);
        return n;
    };
    EXPECT_EQ(n_kept(Keep::failed, adds), 0u);
    EXPECT_EQ(n_kept(Keep::failed, "exit 1"), 1u);
    EXPECT_EQ(n_kept(Keep::all, adds), 1u);
    EXPECT_EQ(n_kept(Keep::none, "exit 1"), 0u);
}

TEST(CommandSimulator, ThreadsWithTheSamePointDoNotMeet) {
    const Folder folder;
    CommandOptions options = script(folder, "sleep 0.05; " + std::string(adds));
    const auto simulator = make_command_simulator(options);
    std::vector<Matrix> answers(6);
    {
        std::vector<std::jthread> threads;
        for (Matrix& answer : answers)
            threads.emplace_back([&] {
                std::vector<std::string> failures;
                simulator->evaluate(Matrix(2, 2, 3), answer, failures);
            });
    }
    for (const Matrix& answer : answers)
        EXPECT_EQ(answer.values, (std::vector<double>{6, 6}));
}

}  // namespace
}  // namespace bemcal::external
