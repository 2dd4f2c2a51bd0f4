#include "posterior/chain_draws.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace bemcal::study {
namespace {

/// A part whose numbers tell chain, draw and column.
sampling::ChainPart part_of(int chain, int first_draw, int n_draws) {
    sampling::ChainPart part;
    part.state = {100.0 + chain, 200.0 + first_draw};
    part.draws = Matrix(static_cast<std::size_t>(n_draws), 2);
    part.statistics = Matrix(static_cast<std::size_t>(n_draws), sampling::n_statistics);
    for (std::size_t d = 0; d < part.draws.rows; ++d) {
        part.draws(d, 0) = chain * 1000 + first_draw + static_cast<int>(d);
        part.draws(d, 1) = -part.draws(d, 0);
        part.statistics(d, 0) = part.draws(d, 0) / 10;
    }
    return part;
}

ItemAnswer answer_of(const std::vector<sampling::ChainPart>& parts) {
    ItemAnswer answer;
    answer.values = posterior::pack_parts(parts);
    return answer;
}

/// Three chains, two to an item: warm-up, then rounds of 2 and 3 draws.
std::vector<ItemAnswer> two_rounds() {
    return {
        answer_of({part_of(0, 0, 0), part_of(1, 0, 0)}), answer_of({part_of(2, 0, 0)}),
        answer_of({part_of(0, 0, 2), part_of(1, 0, 2)}), answer_of({part_of(2, 0, 2)}),
        answer_of({part_of(0, 2, 3), part_of(1, 2, 3)}), answer_of({part_of(2, 2, 3)})};
}

constexpr posterior::ChainLayout layout{3, 2, 2};

TEST(ChainDraws, AllRoundsOfAChainStandTogether) {
    const posterior::ChainDraws draws = posterior::gather_draws(layout, 10, two_rounds());
    ASSERT_EQ(draws.n_chains, 3u);
    ASSERT_EQ(draws.n_draws, 5u);
    EXPECT_EQ(draws.chains, (std::vector<int>{10, 11, 12}));
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t d = 0; d < 5; ++d) {
            EXPECT_EQ(draws.positions(c * 5 + d, 0), c * 1000.0 + d);
            EXPECT_EQ(draws.positions(c * 5 + d, 1), -(c * 1000.0 + d));
            EXPECT_EQ(draws.statistics(c * 5 + d, 0), (c * 1000.0 + d) / 10);
        }
}

TEST(ChainDraws, AnUnknownThatIsTheSameInAllDrawsHasConverged) {
    posterior::ConvergenceTable table;
    stats::Convergence settled;
    settled.mean = 0.95;
    settled.sd = 1e-15;  // of rounding
    settled.rhat_rank = settled.ess_bulk = settled.ess_tail =
        std::numeric_limits<double>::quiet_NaN();
    table.rows = {settled};
    EXPECT_EQ(table.worst_rhat(), 0);
    table.rows[0].sd = 1e-9;  // it moves
    EXPECT_TRUE(std::isnan(table.worst_rhat()));
}

TEST(ChainDraws, TheNextRoundStartsFromTheLastStates) {
    const auto states = posterior::last_states(layout, two_rounds());
    ASSERT_EQ(states.size(), 3u);
    EXPECT_EQ(states[1], (std::vector<double>{101, 202}));
    EXPECT_EQ(posterior::unpack_states(posterior::pack_states(states)), states);
}

TEST(ChainDraws, AChainThatFailedIsLeftOutAndSaysWhy) {
    auto answers = two_rounds();
    for (std::size_t item = 0; item < answers.size(); item += 2) {
        answers[item].values = posterior::pack_parts(
            {{}, part_of(1, item == 4 ? 2 : 0, static_cast<int>(item / 2))});
    }
    // rounds of 0, 1 and 2 draws for chain 1; give the others the same
    for (std::size_t item = 1; item < answers.size(); item += 2)
        answers[item].values = posterior::pack_parts(
            {part_of(2, item == 5 ? 2 : 0, static_cast<int>(item / 2))});
    answers[0].failures.push_back({0, "chain 10: no start"});
    const posterior::ChainDraws draws = posterior::gather_draws(layout, 10, answers);
    EXPECT_EQ(draws.chains, (std::vector<int>{11, 12}));
    EXPECT_EQ(draws.n_draws, 3u);
    EXPECT_EQ(draws.failures, (std::vector<std::string>{"chain 10: no start"}));
    EXPECT_TRUE(posterior::last_states(layout, answers)[0].empty());
}

TEST(ChainDraws, ItemsCountByRoundAndGroup) {
    EXPECT_EQ(layout.n_groups(), 2);
    EXPECT_EQ(layout.round_of(3), 1);
    EXPECT_EQ(layout.first_chain_of(3), 2);
    EXPECT_EQ(layout.n_chains_of(3), 1);
    EXPECT_EQ(layout.n_chains_of(2), 2);
}

}  // namespace
}  // namespace bemcal::study
