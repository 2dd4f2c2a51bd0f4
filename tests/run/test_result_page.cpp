#include "base/error.hpp"
#include "run/result_page.hpp"
#include "support/temporary_folder.hpp"

#include <fstream>

#include <gtest/gtest.h>

namespace bemcal::run {
namespace {

using Lines = std::vector<std::string>;

/// A shell script stands for the writer of pages: it gets RESULT PAGE [--stage STAGE]...
class ResultPage : public ::testing::Test {
  protected:
    PageWriter writer(const std::string& script) const {
        const auto path = folder_ / "result_report";
        std::ofstream(path) << script << "\n";
        return {path, "/bin/sh"};
    }
    std::string text_of(const std::string& name) const {
        std::ifstream file(folder_ / name);
        return {std::istreambuf_iterator<char>(file), {}};
    }
    std::string result() const { return (folder_ / "a.h5").string(); }
    std::string place(const std::string& name) const { return (folder_ / name).string(); }

    test::TemporaryFolder folder_;
};

TEST_F(ResultPage, IsWrittenBesideTheResult) {
    const auto lines =
        writer("echo talk; echo talk >&2; echo $1 $3 >$2").write(result(), {"a/loop"});
    EXPECT_EQ(lines, Lines{"wrote " + place("a.html") + ", the same with pictures"});
    EXPECT_EQ(text_of("a.html"), result() + "\n");
}

TEST_F(ResultPage, OfOneBuildingHasAllOfItsStudies) {
    const auto lines =
        writer("echo $# $4 >$2").write(result(), {"a/screening", "a/loop", "pooled"});
    EXPECT_EQ(lines.size(), 1U);
    EXPECT_EQ(text_of("a.html"), "2\n");
}

TEST_F(ResultPage, OfSeveralBuildingsIsOneForEachAndOneForWhatIsOfNone) {
    const auto lines =
        writer("echo $4 $6 >$2")
            .write(result(), {"shop/loop", "inn/loop", "inn/again", "pooled", "sobol"});
    EXPECT_EQ(lines.size(), 3U);
    EXPECT_EQ(text_of("a-shop.html"), "shop\n");
    EXPECT_EQ(text_of("a-inn.html"), "inn\n");
    EXPECT_EQ(text_of("a.html"), "pooled sobol\n");
}

TEST_F(ResultPage, OfVeryManyBuildingsIsWrittenForTheFirst) {
    std::vector<std::string> stages;
    for (int k = 0; k < 100; ++k) stages.push_back("b" + std::to_string(k) + "/grid");
    const auto lines = writer("echo $4 >$2").write(result(), stages);
    ASSERT_EQ(lines.size(), 13U);
    EXPECT_EQ(text_of("a-b11.html"), "b11\n");
    EXPECT_TRUE(lines[12].starts_with("no pages of the other 88 buildings; to make one"))
        << lines[12];
    EXPECT_TRUE(lines[12].ends_with("a-b12.html --stage b12")) << lines[12];
}

TEST_F(ResultPage, ThatCannotBeMadeIsALineThatSaysHowToMakeIt) {
    const PageWriter failing = writer("exit 3");
    const std::string how = "to make it: " + failing.script->string() + " " + result() +
                            " " + place("a.html");
    const Lines lines = failing.write(result(), {"a/loop"});
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_TRUE(lines[0].starts_with("no page")) << lines[0];
    EXPECT_TRUE(lines[0].ends_with(how)) << lines[0];
    const PageWriter without_python{failing.script, folder_ / "no_such_program"};
    EXPECT_EQ(without_python.write(result(), {"a/loop"}), lines);
    const PageWriter without_script{std::nullopt, "/bin/sh"};
    EXPECT_TRUE(without_script.write(result(), {"a/loop"})[0].ends_with(
        "to make it: scripts/result_report " + result() + " " + place("a.html")));
}

TEST_F(ResultPage, ThatIsOfAnotherHandOrALinkIsKept) {
    std::ofstream(folder_ / "a.html") << "<p>my own page</p>";
    std::filesystem::create_symlink("a.html", folder_ / "b.html");
    const PageWriter writer_of_pages = writer("echo page >$2");
    for (const char* name : {"a.h5", "b.h5"}) {
        const auto lines = writer_of_pages.write(folder_ / name, {"a/loop"});
        EXPECT_NE(lines[0].find("no run wrote it"), std::string::npos) << lines[0];
    }
    EXPECT_EQ(text_of("a.html"), "<p>my own page</p>");
}

TEST_F(ResultPage, MadeBeforeIsMadeAnew) {
    const PageWriter twice = writer("echo '<meta content=\"bemcal-batch\">' $3 >$2");
    twice.write(result(), {"a/loop"});
    EXPECT_TRUE(twice.write(result(), {"a/loop"})[0].starts_with("wrote"));
}

TEST_F(ResultPage, ThatCannotBeWrittenIsAnErrorAndLeavesNothing) {
    EXPECT_THROW(writer("exit 74").write(result(), {"a/loop"}), UserError);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_.path()),
                            std::filesystem::directory_iterator()),
              1);
}

TEST_F(ResultPage, OfNoStudyIsNone) {
    EXPECT_TRUE(writer("exit 0").write(result(), {}).empty());
}

}  // namespace
}  // namespace bemcal::run
