/// Compares prior and posterior of each parameter: how far the variance has fallen, the
/// mean moved, the range narrowed; its strongest correlation; crowding at an end.
/// Follows from moments and quantiles of both; correlation is Pearson's.
/// Leaves out several modes, and ties among more than two. The words are in `finding`.
#include "posterior/contraction.hpp"

#include "base/error.hpp"
#include "base/nan.hpp"
#include "stats/chain_moments.hpp"
#include "stats/coverage.hpp"

#include <algorithm>
#include <cmath>

namespace bemcal::posterior {
namespace {

/// A prior, or a discrete parameter's values as one, by its numbers.
struct Belief {
    double mean, sd, q05, q95;
    double least, most;  ///< of the range; infinite where it is open

    explicit Belief(const study::Coordinate& coordinate) {
        if (coordinate.values.empty())
            take(coordinate.prior);
        else
            take(coordinate.values);
    }
    double width() const { return q95 - q05; }

  private:
    void take(const stats::Prior& prior) {
        mean = prior.mean();
        sd = prior.sd();
        q05 = prior.quantile(0.05);
        q95 = prior.quantile(0.95);
        least = prior.quantile(0);
        most = prior.quantile(1);
    }
    void take(std::vector<double> values) {
        std::ranges::sort(values);
        mean = stats::mean_of(values);
        const double n = static_cast<double>(values.size());
        sd = std::sqrt(stats::covariance_of(values, values) * (n - 1) / n);
        q05 = least = values.front();
        q95 = most = values.back();
    }
};

template <class IsNear>
Edge edge_at(const char* name, double at, double prior, const std::vector<double>& values,
             IsNear is_near) {
    const double n = static_cast<double>(std::ranges::count_if(values, is_near));
    return {name, at, values.empty() ? 0 : n / static_cast<double>(values.size()), prior};
}

/// The fuller end of a closed range; an open one, and a discrete parameter, have none.
Edge fuller_edge(const study::Coordinate& coordinate, const Belief& belief,
                 const std::vector<double>& values, double strip) {
    const double range = belief.most - belief.least;
    if (!coordinate.values.empty() || !std::isfinite(range)) return {"", nan, 0, 1};
    const double width = strip * range;
    const double low = belief.least + width, high = belief.most - width;
    const stats::Prior& prior = coordinate.prior;
    const Edge lower = edge_at("lower", belief.least, prior.cdf(low), values,
                               [low](double x) { return x <= low; });
    const Edge upper = edge_at("upper", belief.most, 1 - prior.cdf(high), values,
                               [high](double x) { return x >= high; });
    return lower.draws >= upper.draws ? lower : upper;
}

bool is_fixed(const study::Coordinate& coordinate) {
    return coordinate.values.size() == 1 ||
           (coordinate.values.empty() &&
            coordinate.prior.kind == stats::PriorKind::fixed);
}

/// What another unknown sizes has no belief of its own to compare with.
bool is_compared(const study::Coordinate& coordinate) {
    return !is_fixed(coordinate) && !coordinate.in;
}

ParameterMove unmoved(const study::Coordinate& coordinate) {
    ParameterMove move;
    move.name = coordinate.name;
    const double value =
        coordinate.values.empty() ? coordinate.prior.mean() : coordinate.values.front();
    move.prior_mean = move.posterior_mean = value;
    move.contraction = move.shift = move.range_share = move.correlation = nan;
    move.words = coordinate.in ? "" : "fixed";
    return move;
}

ParameterMove numbers_of(const study::Coordinate& coordinate, const Belief& belief,
                         std::vector<double> values) {
    std::ranges::sort(values);
    ParameterMove move;
    move.name = coordinate.name;
    move.prior_mean = belief.mean;
    move.prior_sd = belief.sd;
    move.posterior_mean = stats::mean_of(values);
    move.posterior_sd = std::sqrt(stats::variance_of(values));
    const double ratio = move.posterior_sd / belief.sd;
    move.contraction = 1 - ratio * ratio;
    move.shift = (move.posterior_mean - belief.mean) / belief.sd;
    move.range_share = (stats::predictive_quantile(values, 0.95) -
                        stats::predictive_quantile(values, 0.05)) /
                       belief.width();
    return move;
}

/// Minus the mean, over the sd; NaN where it does not vary.
std::vector<double> standardised(std::vector<double> values) {
    const double mean = stats::mean_of(values);
    const double sd = std::sqrt(stats::variance_of(values));
    for (double& value : values) value = (value - mean) / sd;
    return values;
}

double correlation_of(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    for (std::size_t k = 0; k < a.size(); ++k) sum += a[k] * b[k];
    return sum / (static_cast<double>(a.size()) - 1);
}

/// Each coordinate's strongest correlation with another one that is not fixed.
class Partners {
  public:
    Partners(const std::vector<study::Coordinate>& coordinates, const Matrix& draws)
        : best_(coordinates.size(), {0, nan}) {
        columns_.reserve(coordinates.size());
        for (std::size_t c = 0; c < coordinates.size(); ++c)
            columns_.push_back(is_compared(coordinates[c])
                                   ? standardised(draws.column(c))
                                   : std::vector<double>(draws.rows, nan));
        for (std::size_t a = 0; a < coordinates.size(); ++a)
            for (std::size_t b = a + 1; b < coordinates.size(); ++b) compare(a, b);
    }

    struct Partner {
        std::size_t index;
        double correlation;  ///< NaN: none
    };
    const Partner& of(std::size_t c) const { return best_[c]; }

  private:
    void compare(std::size_t a, std::size_t b) {
        const double r = correlation_of(columns_[a], columns_[b]);
        if (std::isnan(r)) return;
        if (!(std::abs(r) <= std::abs(best_[a].correlation))) best_[a] = {b, r};
        if (!(std::abs(r) <= std::abs(best_[b].correlation))) best_[b] = {a, r};
    }

    std::vector<std::vector<double>> columns_;
    std::vector<Partner> best_;
};

void judge_move(ParameterMove& move, const Edge& edge, const ContractionLimits& limits) {
    const Statement statement =
        judge({move.contraction, move.shift, move.posterior_sd / move.prior_sd,
               move.partner, move.correlation, edge},
              limits);
    move.finding = statement.finding;
    move.words = statement.words;
}

}  // namespace

std::vector<ParameterMove> moves_of(const std::vector<study::Coordinate>& coordinates,
                                    const Matrix& draws,
                                    const ContractionLimits& limits) {
    require(draws.cols == coordinates.size(), "as many columns of draws as coordinates");
    const Partners partners(coordinates, draws);
    std::vector<ParameterMove> moves;
    moves.reserve(coordinates.size());
    for (std::size_t c = 0; c < coordinates.size(); ++c) {
        if (!is_compared(coordinates[c])) {
            moves.push_back(unmoved(coordinates[c]));
            continue;
        }
        const Belief belief(coordinates[c]);
        const std::vector<double> values = draws.column(c);
        ParameterMove& move =
            moves.emplace_back(numbers_of(coordinates[c], belief, values));
        const auto& [partner, correlation] = partners.of(c);
        move.correlation = correlation;
        if (!std::isnan(correlation)) move.partner = coordinates[partner].name;
        judge_move(move, fuller_edge(coordinates[c], belief, values, limits.edge_strip),
                   limits);
    }
    return moves;
}

}  // namespace bemcal::posterior
