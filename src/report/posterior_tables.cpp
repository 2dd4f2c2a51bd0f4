/// A posterior's tables from its stored draws alone: whether chains have converged, each
/// unknown before and after, and what the data could tell.
/// Convergence is computed again by convergence_of. What the data could tell is the
/// stored sentence; correlations among unknowns are not shown.
#include "base/nan.hpp"
#include "report/sections.hpp"
#include "report/simulator_tables.hpp"
#include "report/text_table.hpp"
#include "stats/convergence.hpp"
#include "stats/quantile.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace bemcal::report {
namespace {

/// Above it squares are not finite, and no order of the draws is one.
constexpr double most_draw = 1e75;

/// \return [chains x draws]; empty where the dataset is not there
Matrix matrix_of(const Group& group, const std::string& leaf) {
    const std::vector<std::size_t> shape = group.shape(leaf);
    if (shape.size() != 2) return {};
    const Numbers& draws = group.values(leaf);
    for (const double draw : draws)
        if (!(std::abs(draw) < most_draw))
            draws.refuse(fmt::format("{} is no draw", draw));
    Matrix matrix;
    matrix.rows = shape[0];
    matrix.cols = shape[1];
    matrix.values = draws;
    if (draws.size() != shape[0] * shape[1]) draws.refuse("it does not hold numbers");
    return matrix;
}

struct Moments {
    double mean = nan, sd = nan;
};
Moments moments_of(const std::vector<double>& values) {
    const auto n = static_cast<double>(values.size());
    if (n < 2) return {};
    double sum = 0, squares = 0;
    for (const double value : values) sum += value;
    for (const double value : values) squares += (value - sum / n) * (value - sum / n);
    return {sum / n, std::sqrt(squares / (n - 1))};
}

/// One unknown: what was believed, what is believed, and how sure the chains are.
struct Unknown {
    std::string name, unit;
    Moments prior;
    std::vector<double> sorted;
    stats::Convergence convergence;
    std::size_t n_chains = 0, n_draws = 0;

    /// How much narrower than before, 1 - posterior variance / prior variance.
    double contraction() const {
        return 1 - convergence.sd * convergence.sd / (prior.sd * prior.sd);
    }
};

Unknown unknown_of(std::string name, std::string unit, const Matrix& draws,
                   const std::vector<double>& prior) {
    Unknown unknown{std::move(name),
                    std::move(unit),
                    moments_of(prior),
                    draws.values,
                    stats::convergence_of(draws),
                    draws.rows,
                    draws.cols};
    std::ranges::sort(unknown.sorted);
    return unknown;
}

/// Those with draws; the log density, which has no group of its own, last.
std::vector<Unknown> unknowns_of(const Group& study) {
    std::vector<Unknown> unknowns;
    const auto &names = study.texts("unknown"), &units = study.texts("unknown_unit");
    const Group draws = study.inner("posterior"), prior = study.inner("prior");
    unknowns.reserve(names.size());
    for (std::size_t u = 0; u < names.size(); ++u)
        if (draws.has(names[u]))
            unknowns.push_back(unknown_of(names[u], units[u], matrix_of(draws, names[u]),
                                          prior.values(names[u])));
    const Group statistics = study.inner("sample_stats");
    if (statistics.has("lp"))
        unknowns.push_back(
            unknown_of("log_density", "-", matrix_of(statistics, "lp"), {}));
    return unknowns;
}

std::string with_digits(double value, int digits) {
    if (!std::isfinite(value)) return "-";
    if (std::abs(value) >= 1e6) return fmt::format("{:.1e}", value);
    return fmt::format("{:.{}f}", value, digits);
}

/// What the chains have reached; computed again, not taken from the file.
std::string convergence_line(const Group& study, const std::vector<Unknown>& unknowns) {
    if (unknowns.empty()) return "NOT CONVERGED: no chain has a draw\n";
    double rhat = 0, ess = std::numeric_limits<double>::infinity();
    bool is_defined = true;
    for (const Unknown& unknown : unknowns) {
        const stats::Convergence& c = unknown.convergence;
        if (!(c.sd > 0)) continue;  // fixed
        is_defined = is_defined && std::isfinite(c.rhat_rank);
        rhat = std::max(rhat, c.rhat_rank);
        ess = std::min({ess, c.ess_bulk, c.ess_tail});
    }
    const double most = study.value("target_rhat"), least = study.value("target_ess");
    const bool is_reached = is_defined && rhat <= most && ess >= least;
    return fmt::format(
        "{}: {} chains of {} draws\n  rank R-hat {} (target {}), effective draws "
        "at least {} (target {:.0f})\n",
        is_reached ? "converged" : "NOT CONVERGED", unknowns[0].n_chains,
        unknowns[0].n_draws, is_defined ? "at most " + with_digits(rhat, 3) : "undefined",
        in_short(most), with_digits(ess, 0), least);
}

/// With as many decimals as two digits of its spread have.
std::string to_spread(double value, double sd) {
    constexpr int most_decimals = 6;
    std::string shown = in_short(value);
    if (!(sd > 0) || !std::isfinite(sd) || shown.find('e') != std::string::npos ||
        !std::isfinite(value))
        return shown;
    const int needed =
        std::clamp(1 - static_cast<int>(std::floor(std::log10(sd))), 0, most_decimals);
    const std::size_t point = shown.find('.');
    const std::size_t has = point == std::string::npos ? 0 : shown.size() - point - 1;
    return static_cast<std::size_t>(needed) > has ? fmt::format("{:.{}f}", value, needed)
                                                  : shown;
}

/// Mean and standard deviation.
std::string plus_minus(double mean, double sd) {
    return fmt::format("{} +- {}", to_spread(mean, sd), in_short(sd));
}

/// "evenings by hour of the week 12": there may be fifty of a function.
bool is_column(const std::string& unknown, const std::vector<std::string>& functions) {
    const auto name_end = unknown.find_last_not_of("0123456789");
    return name_end + 1 < unknown.size() &&
           std::ranges::any_of(functions, [&](const std::string& function) {
               return unknown.substr(0, name_end + 1) == function + " ";
           });
}

/// Those that tell a reader something: without the columns that functions are made of.
std::vector<Unknown> without_columns(std::vector<Unknown> unknowns, const Group& study) {
    if (!study.has("function")) return unknowns;
    std::erase_if(unknowns, [&](const Unknown& unknown) {
        return is_column(unknown.name, study.texts("function"));
    });
    return unknowns;
}

/// Functions whose values were sampled, by their lowest and highest one.
std::string function_table(const Group& study) {
    if (!study.has("function")) return {};
    const Numbers &of = study.values("function_point_of"),
                  &value = study.values("function_point_value"),
                  &least = study.values("function_point_least"),
                  &most = study.values("function_point_most");
    TextTable table({"function", "unit", "lowest value", "highest value", "90 % band"});
    for (std::size_t f = 0; f < study.texts("function").size(); ++f) {
        double low = nan, high = nan, width = 0, n = 0;
        for (std::size_t p = 0; p < of.size(); ++p) {
            if (of[p] != static_cast<double>(f)) continue;
            low = std::fmin(low, value[p]);
            high = std::fmax(high, value[p]);
            width += most[p] - least[p];
            n += 1;
        }
        table.add({study.texts("function")[f], study.texts("function_unit")[f],
                   in_short(low), in_short(high), "+- " + in_short(width / (2 * n))});
    }
    return table.text(24);
}

std::string estimates_table(const std::vector<Unknown>& unknowns) {
    TextTable table({"unknown", "unit", "prior", "posterior", "5 %", "50 %", "95 %"});
    for (const Unknown& unknown : unknowns) {
        const stats::Convergence& c = unknown.convergence;
        if (unknown.name == "log_density") continue;
        const auto quantile = [&](double p) {
            return to_spread(stats::quantile_of_sorted(unknown.sorted, p), c.sd);
        };
        table.add(
            {unknown.name, unknown.unit, plus_minus(unknown.prior.mean, unknown.prior.sd),
             plus_minus(c.mean, c.sd), quantile(0.05), quantile(0.5), quantile(0.95)});
    }
    return table.text(21);
}

std::string chains_table(const std::vector<Unknown>& unknowns) {
    TextTable table({"unknown", "R", "split", "rank R-hat", "ESS bulk", "ESS tail",
                     "MCSE mean", "MCSE sd", "contracts"});
    for (const Unknown& unknown : unknowns) {
        const stats::Convergence& c = unknown.convergence;
        table.add({unknown.name, with_digits(c.gelman_rubin, 3),
                   with_digits(c.rhat_split, 3), with_digits(c.rhat_rank, 3),
                   with_digits(c.ess_bulk, 0), with_digits(c.ess_tail, 0),
                   in_short(c.mcse_mean), in_short(c.mcse_sd),
                   percent(unknown.contraction())});
    }
    return table.text(24);
}

/// What the data could tell of each unknown, in words.
std::string words(const Group& study) {
    const auto &names = study.texts("unknown"), &sentences = study.texts("data_words");
    std::string text;
    for (std::size_t u = 0; u < std::min(names.size(), sentences.size()); ++u)
        if (!sentences[u].empty())
            text += fmt::format("  {}: {}\n", names[u], sentences[u]);
    return text;
}

std::string divergence_line(const Group& study) {
    double n = 0;
    for (const double value : study.inner("sample_stats").values("diverging")) n += value;
    if (!(n > 0)) return {};
    return fmt::format(
        "  {:.0f} transitions diverged: the posterior may have corners that "
        "the chains do not enter\n",
        n);
}

}  // namespace

std::string posterior_section(const Group& study) {
    const std::vector<Unknown> unknowns = unknowns_of(study);
    const std::vector<Unknown> told = without_columns(unknowns, study);
    return fmt::format("\n{}: {}", study.path(), convergence_line(study, unknowns)) +
           estimates_table(told) + function_table(study) + chains_table(told) +
           divergence_line(study) + words(study) + simulator_run_lines(study) +
           field_tables(study) + validation_tables(study) + failure_lines(study);
}

}  // namespace bemcal::report
