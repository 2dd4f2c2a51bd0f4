/// Prior against posterior, parameter by parameter.
#include "study/contraction.hpp"

#include "base/error.hpp"
#include "stats/chain_moments.hpp"
#include "stats/coverage.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace bemcal::study {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// A prior, or a discrete parameter's values as one, by its numbers.
struct Belief {
    double mean, sd, q05, q95;
    double least, most;  ///< of the range; infinite where it is open

    explicit Belief(const Coordinate& coordinate) {
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

std::vector<double> column_of(const Matrix& draws, std::size_t column) {
    std::vector<double> values(draws.rows);
    for (std::size_t d = 0; d < draws.rows; ++d) values[d] = draws(d, column);
    return values;
}

/// An end of the range, with the share of draws and of the prior in its neighbourhood.
struct Edge {
    const char* name;
    double at, draws, prior;
};

template <class IsNear>
Edge edge_at(const char* name, double at, double prior, const std::vector<double>& values,
             IsNear is_near) {
    const double n = static_cast<double>(std::ranges::count_if(values, is_near));
    return {name, at, n / static_cast<double>(values.size()), prior};
}

/// The fuller end; a range that is open on one side is as wide as the prior's 90 %. A
/// discrete parameter has none.
Edge fuller_edge(const Coordinate& coordinate, const Belief& belief,
                 const std::vector<double>& values, double strip) {
    if (!coordinate.values.empty()) return {"", nan, 0, 1};
    const double range = belief.most - belief.least;
    const double width = strip * (std::isfinite(range) ? range : belief.width());
    const double low = belief.least + width, high = belief.most - width;
    const stats::Prior& prior = coordinate.prior;
    const Edge lower = edge_at("lower", belief.least, prior.cdf(low), values,
                               [low](double x) { return x <= low; });
    const Edge upper = edge_at("upper", belief.most, 1 - prior.cdf(high), values,
                               [high](double x) { return x >= high; });
    return lower.draws >= upper.draws ? lower : upper;
}

/// What a finding is made of, beside the move's own numbers.
struct Evidence {
    const ParameterMove& move;
    Edge edge;
    const ContractionLimits& limits;
};

struct Rule {
    Finding finding;
    bool (*holds)(const Evidence&);
    std::string (*words)(const Evidence&);
};

/// The first rule that holds gives the finding and its words.
constexpr Rule rules[] = {
    {Finding::at_edge,
     [](const Evidence& e) {
         return e.edge.draws >= e.limits.edge_share &&
                e.edge.draws >= e.limits.edge_factor * e.edge.prior;
     },
     [](const Evidence& e) {
         return fmt::format(
             "at the {} end of its range ({:.0f} % of the draws are near {:.4g}): the "
             "range "
             "or the model is wrong",
             e.edge.name, 100 * e.edge.draws, e.edge.at);
     }},
    {Finding::determined,
     [](const Evidence& e) { return e.move.contraction >= e.limits.determined; },
     [](const Evidence& e) {
         return fmt::format(
             "the data determine it: {:.0f} % of the prior's spread is left",
             100 * e.move.posterior_sd / e.move.prior_sd);
     }},
    {Finding::confounded,
     [](const Evidence& e) {
         return std::abs(e.move.correlation) >= e.limits.correlation;
     },
     [](const Evidence& e) {
         return fmt::format("the data cannot tell it apart from {} (correlation {:.2f})",
                            e.move.partner, e.move.correlation);
     }},
    {Finding::wider,
     [](const Evidence& e) { return e.move.contraction < e.limits.wider; },
     [](const Evidence& e) {
         return fmt::format(
             "less certain than believed before ({:.0f} % of the prior's spread): prior "
             "and "
             "data disagree",
             100 * e.move.posterior_sd / e.move.prior_sd);
     }},
    {Finding::as_before,
     [](const Evidence& e) {
         return e.move.contraction < e.limits.as_before &&
                std::abs(e.move.shift) < e.limits.unmoved;
     },
     [](const Evidence&) {
         return std::string("as believed before: the data say nothing");
     }},
    {Finding::moved,
     [](const Evidence& e) { return e.move.contraction < e.limits.as_before; },
     [](const Evidence& e) {
         return fmt::format(
             "moved by {:+.1f} of the prior's spread, but as uncertain as before",
             e.move.shift);
     }},
    {Finding::narrowed, [](const Evidence&) { return true; },
     [](const Evidence& e) {
         return fmt::format("the data narrow it: {:.0f} % of the prior's spread is left",
                            100 * e.move.posterior_sd / e.move.prior_sd);
     }},
};

void judge(ParameterMove& move, const Edge& edge, const ContractionLimits& limits) {
    const Evidence evidence{move, edge, limits};
    const Rule* rule =
        std::ranges::find_if(rules, [&](const Rule& r) { return r.holds(evidence); });
    move.words = rule->words(evidence);
    move.finding = rule->finding;
}

bool is_fixed(const Coordinate& coordinate) {
    return coordinate.values.size() == 1 ||
           (coordinate.values.empty() &&
            coordinate.prior.kind == stats::PriorKind::fixed);
}

ParameterMove unmoved(const Coordinate& coordinate) {
    ParameterMove move;
    move.name = coordinate.name;
    const double value =
        coordinate.values.empty() ? coordinate.prior.mean() : coordinate.values.front();
    move.prior_mean = move.posterior_mean = value;
    move.contraction = move.shift = move.range_share = move.correlation = nan;
    move.words = "fixed";
    return move;
}

ParameterMove numbers_of(const Coordinate& coordinate, const Belief& belief,
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

double correlation_of(const std::vector<double>& a, const std::vector<double>& b) {
    const double scale = std::sqrt(stats::variance_of(a) * stats::variance_of(b));
    return scale > 0 ? stats::covariance_of(a, b) / scale : nan;
}

class Moves {
  public:
    Moves(const std::vector<Coordinate>& coordinates, const Matrix& draws)
        : coordinates_(coordinates) {
        columns_.reserve(coordinates.size());
        for (std::size_t c = 0; c < coordinates.size(); ++c)
            columns_.push_back(column_of(draws, c));
    }

    ParameterMove of(std::size_t c, const ContractionLimits& limits) const {
        const Coordinate& coordinate = coordinates_[c];
        if (is_fixed(coordinate)) return unmoved(coordinate);
        const Belief belief(coordinate);
        ParameterMove move = numbers_of(coordinate, belief, columns_[c]);
        find_partner(c, move);
        judge(move, fuller_edge(coordinate, belief, columns_[c], limits.edge_strip),
              limits);
        return move;
    }

  private:
    void find_partner(std::size_t c, ParameterMove& move) const {
        move.correlation = nan;
        for (std::size_t other = 0; other < columns_.size(); ++other) {
            if (other == c || is_fixed(coordinates_[other])) continue;
            const double r = correlation_of(columns_[c], columns_[other]);
            if (std::isnan(r) || std::abs(r) <= std::abs(move.correlation)) continue;
            move.correlation = r;
            move.partner = coordinates_[other].name;
        }
    }

    const std::vector<Coordinate>& coordinates_;
    std::vector<std::vector<double>> columns_;
};

}  // namespace

const char* name_of(Finding finding) {
    constexpr const char* names[] = {"fixed", "at_edge",   "determined", "confounded",
                                     "wider", "as_before", "moved",      "narrowed"};
    return names[static_cast<int>(finding)];
}

std::vector<ParameterMove> moves_of(const std::vector<Coordinate>& coordinates,
                                    const Matrix& draws,
                                    const ContractionLimits& limits) {
    require(draws.cols == coordinates.size(), "as many columns of draws as coordinates");
    require(draws.rows > 1, "a posterior needs draws");
    const Moves moves(coordinates, draws);
    std::vector<ParameterMove> all;
    all.reserve(coordinates.size());
    for (std::size_t c = 0; c < coordinates.size(); ++c)
        all.push_back(moves.of(c, limits));
    return all;
}

}  // namespace bemcal::study
