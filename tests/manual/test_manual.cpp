/// Man pages and completions of a small command line.
#include "manual/completion.hpp"
#include "manual/man_pages.hpp"

#include <gtest/gtest.h>

namespace bemcal::manual {
namespace {

Program small_program() {
    return {"some-tool",
            "1.2",
            "Does things.",
            "Exit codes: 0 done.",
            {{"check",
              "read it",
              {{{"-h", "--help"}, "", "Print this"},
               {{}, "JOB", "job file"},
               {{"--nodes"}, "INT", "it's [1] node"},
               {{"-o", "--output"}, "FILE", "result"},
               {{"--meter"}, "FILE[:COLUMN]", "readings", true}}},
             {"describe", "print it", {{{}, "TOPIC", "job or meter"}}}},
            {"job", "meter"}};
}

TEST(ManPage, HasEachCommandWithItsOptions) {
    const std::string page = man_page_of(small_program());
    EXPECT_TRUE(page.starts_with(".TH some\\-tool 1 "));
    EXPECT_NE(page.find(".SS check\n\\fBsome\\-tool check\\fR \\fIJOB\\fR\n"),
              std::string::npos)
        << page;
    EXPECT_NE(page.find(".TP\n\\fB\\-h\\fR, \\fB\\-\\-help\\fR\nPrint this\n"),
              std::string::npos)
        << page;
    EXPECT_NE(page.find(".TP\n\\fB\\-\\-nodes\\fR \\fIINT\\fR\n"), std::string::npos)
        << page;
}

TEST(ManPage, OfAJobHasSectionsKeysAndExamplesAsTheyStand) {
    const std::string page = man_page_of_job(
        small_program(),
        "A job is a file.\n\n[plant]\n  What turns heat.\n"
        "  cop                      default 3  0.01 to 50. Heat\n"
        "  Example:\n    [plant]\n    cop = 3\n\n    .x = '\\'\n\n[run]\n  How.\n");
    EXPECT_NE(page.find(".SS [plant]\nWhat turns heat.\n.TP\n\\fBcop\\fR\ndefault 3  "
                        "0.01 to 50. Heat\n.PP\n.EX\n[plant]\ncop = 3\n\\&\n"
                        "\\&.x = '\\e'\n.EE\n.SS [run]\nHow.\n"),
              std::string::npos)
        << page;
}

TEST(Completion, OfBashHasCommandsOptionsTopicsAndEndings) {
    const std::string script = bash_completion(small_program());
    for (const char* words :
         {"words=\"check describe\"", "options=\"-h --help --nodes -o --output --meter\"",
          "words=\"job meter\"", "endings=\"toml csv\"",
          "endings=\"toml csv\"\n            [[ $option == --meter ]] && "
          "endings=\"csv csv.gz xlsx xml\"\n            ;;\n",
          "complete -o filenames -F _some_tool some-tool\n"})
        EXPECT_NE(script.find(words), std::string::npos) << words << "\n" << script;
}

TEST(Completion, OfZshQuotesWhatItWouldTakeForItsOwn) {
    const std::string script = zsh_completion(small_program());
    EXPECT_TRUE(script.starts_with("#compdef some-tool\n"));
    EXPECT_NE(script.find("'--nodes[it'\\''s \\[1\\] node]:INT: '"), std::string::npos)
        << script;
}

TEST(Completion, OfZshKnowsFilesAndWhatIsRepeated) {
    const std::string script = zsh_completion(small_program());
    for (const char* words :
         {"'(-o --output)--output[result]:FILE:_files'",
          "'*--meter[readings]:FILE:_files -g \"*.(csv|csv.gz|xlsx|xml)\"'",
          "'*:file:_files -g \"*.(toml|csv)\"'"})
        EXPECT_NE(script.find(words), std::string::npos) << words << "\n" << script;
    Program of_results = small_program();
    of_results.commands[0].options[1].value = "RESULT";
    EXPECT_NE(zsh_completion(of_results).find("_files -g \"*.h5\"'"), std::string::npos);
}

TEST(Completion, KnowsTheFilesOfOptions) {
    Program first = small_program();
    first.commands[0].options.push_back({{"--idf"}, "FILE", "a model"});
    first.commands[0].options.push_back({{"--weather"}, "FILE", "a year"});
    EXPECT_NE(
        bash_completion(first).find("[[ $option == --idf ]] && endings=\"idf epJSON\""),
        std::string::npos);
    for (const char* words : {"--idf[a model]:FILE:_files -g \"*.(idf|epJSON)\"'",
                              "--weather[a year]:FILE:_files -g "
                              "\"*.(epw|epw.gz|csv|csv.gz)\"'"})
        EXPECT_NE(zsh_completion(first).find(words), std::string::npos) << words;
}

}  // namespace
}  // namespace bemcal::manual
