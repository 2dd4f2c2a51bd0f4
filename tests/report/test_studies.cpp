/// What kind a study is: told by the result itself, of every kind, and of version 0.1.0.
#include "job/kinds.hpp"
#include "job/small_office.hpp"
#include "job/stages.hpp"
#include "report/studies.hpp"
#include "report/tables.hpp"
#include "store/dataset_path.hpp"
#include "store/layout.hpp"

#include <algorithm>
#include <iterator>

#include <gtest/gtest.h>

namespace bemcal::report {
namespace {

using job::replaced;
using study::Dataset;

/// A study of every kind, small.
struct Sample {
    const char *kind, *keys;
    bool was_in_0_1_0 = true;
};
constexpr const char* chains =
    "n_chains = 2\nwarm_up = 2\ndraws_per_round = 2\nmost_draws = 2\nn_predictive = 2\n"
    "sampler = \"random_walk\"\n";
constexpr Sample samples[] = {
    {"sensitivity", "n_base = 4\nn_bootstrap = 0\n"},
    {"hourly_sensitivity", "n_base = 64\n"},
    {"office_hour_sensitivity",
     "n_base = 4\nn_bootstrap = 0\nfixed = {DayNum = [1, 2]}\n"},
    {"screening", "n_points = 8\n"},
    {"posterior", chains},
    {"kennedy_ohagan",
     "field = \"field.csv\"\nfield_output = \"y\"\ninputs = [\"x\"]\ncalibrated = "
     "[\"t\"]\nruns = \"runs.csv\"\n"},
    {"loop", "most_effects = 0\ntry_structures = false\n"},
    {"optimisation", "evaluations = 40\n"},
    {"retrofit", "of = \"screened\"\n[[scenario]]\nname = \"as it is\"\n"},
    {"grid",
     "k = 1\nmost_stages = 1\ngrid = {infiltration = [0.3, 0.4]}\n[[study.target]]\n"
     "quantity = \"electricity\"\nmeasured = 5000\n"},
    {"stages",
     "evaluations = 20\nat_once = false\n[[study.stage]]\nname = \"all\"\n"
     "periods = [\"training\"]\nparameters = [\"infiltration\"]\n"}};

std::string keys_of(const std::string& kind) {
    for (const Sample& sample : samples)
        if (kind == sample.kind)
            return kind == "kennedy_ohagan" ? sample.keys + std::string(chains)
                                            : sample.keys;
    throw std::logic_error("no sample of kind " + kind);
}

/// The sample job with a screening and a study of that kind in place of its studies.
std::string text_with(const std::string& kind) {
    std::string text = job::small_office_text();
    text.erase(text.find("[[study]]"), text.find("[output]") - text.find("[[study]]"));
    return text +
           "\n[[study]]\nname = \"screened\"\nkind = \"screening\"\nn_points = 4\n" +
           "\n[[study]]\nname = \"sample\"\nkind = \"" + kind + "\"\n" + keys_of(kind);
}

std::vector<study::ItemAnswer> answers_of(study::Stage& stage) {
    std::vector<study::ItemAnswer> answers;
    for (int count = stage.n_items(); count > 0;) {
        const auto first = static_cast<int>(answers.size());
        for (int item = first; item < first + count; ++item)
            answers.push_back(stage.run(item));
        const auto round = stage.next_round(answers);
        count = round ? round->n_items : 0;
        if (round) stage.begin_round(static_cast<int>(answers.size()), *round);
    }
    return answers;
}

store::ResultFile result_of(const std::string& kind) {
    const job::Folder folder;
    folder.write("field.csv", "y,x\n1,0\n2,0.5\n3,1\n");
    folder.write("runs.csv", "y,x,t\n1,0,0\n2,0.5,0\n3,1,0\n2,0,1\n3,0.5,1\n5,1,1\n");
    const job::Job job = job::read_job(job::write_small_office(folder, text_with(kind)));
    store::ResultFile result;
    std::vector<study::Summary> found;
    for (const auto& stage : job::make_plan(job)) {
        stage->see(found);
        study::Conclusion conclusion = stage->conclude(answers_of(*stage));
        std::ranges::move(conclusion.datasets, std::back_inserter(result.datasets));
        std::ranges::move(conclusion.summaries, std::back_inserter(found));
    }
    return result;
}

/// Without what version 0.1.0 did not store.
store::ResultFile of_0_1_0(store::ResultFile result) {
    std::erase_if(result.datasets,
                  [](const Dataset& d) { return store::leaf_of(d.path) == "kind"; });
    return result;
}

class EveryKind : public testing::TestWithParam<Sample> {};

TEST_P(EveryKind, SaysItsWordInItsResultAndIsShownWithoutItTheSame) {
    const std::string kind = GetParam().kind;
    const store::ResultFile result = result_of(kind);
    std::vector<std::string> kinds;
    for (const StoredStudy& study : studies_in(result))
        if (study.group.path().find("sample") != std::string::npos)
            kinds.push_back(study.kind);
    const std::size_t n = kind == "office_hour_sensitivity" ? 2 : 1;  // cases
    EXPECT_EQ(kinds, std::vector<std::string>(n, kind));
    const std::string text = tables_of(result);
    EXPECT_NE(text.find("sample"), std::string::npos) << text;
    if (GetParam().was_in_0_1_0) {
        EXPECT_EQ(tables_of(of_0_1_0(result)), text);
    }
}

INSTANTIATE_TEST_SUITE_P(Studies, EveryKind, testing::ValuesIn(samples),
                         [](const auto& each) { return std::string(each.param.kind); });

TEST(Studies, HaveASampleOfEveryKindHere) {
    for (const job::Kind* kind : job::kinds()) EXPECT_NO_THROW(keys_of(kind->word));
}

TEST(Studies, OfOneResultMayBeOfManyKindsAndGroupsBelowAreNone) {
    store::ResultFile result;
    const auto add = [&](const char* path, const char* word) {
        result.datasets.push_back({path, {}, {}, {}, {word}});
    };
    add("a/screening/kind", "screening");
    add("pooled/kind", "posterior");
    add("stock/kind", "stock");
    result.datasets.push_back({"pooled/posterior/kind", {"chain"}, {1}, {2}, {}});
    std::string found;
    for (const StoredStudy& study : studies_in(result))
        found += study.group.path() + ":" + study.kind + " ";
    EXPECT_EQ(found, "a/screening:screening pooled:posterior stock:stock ");
}

TEST(Studies, OfAKindWithoutTablesOfItsOwnAreShownAsTheyAreStored) {
    store::ResultFile result;
    const std::string g = "office/dream/";
    result.datasets = {
        {g + "kind", {}, {}, {}, {"dream"}},
        {g + "n_points", {}, {}, {12}, {}},
        {g + "output", {"output"}, {2}, {}, {"heating", "gas"}},
        {g + "output_mean", {"output"}, {2}, {2.5, 7}, {}, "kWh"},
        {g + "parameter", {"parameter"}, {1}, {}, {"walls"}},
        {g + "total_order", {"output", "parameter"}, {2, 1}, {0.25, 1}, {}},
        {g + "n_failed", {}, {}, {1}, {}},
        {g + "failed_reason", {"failure"}, {1}, {}, {"too hot"}}};
    EXPECT_EQ(tables_of(result),
              "\noffice/dream: dream\n"
              "  n_points: 12\n"
              "  output   output_mean [kWh]\n"
              "  heating               2.50\n"
              "  gas                      7\n"
              "  total_order   walls\n"
              "  heating      0.2500\n"
              "  gas               1\n"
              "  1 simulation failed:\n"
              "         1 x too hot\n");
}

}  // namespace
}  // namespace bemcal::report
