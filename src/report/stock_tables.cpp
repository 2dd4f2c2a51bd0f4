/// A night over a stock: how many buildings were done, which failed, drift or predict
/// worst; and its table as CSV.
/// Source: RFC 4180 for the CSV. Made from stored datasets alone. Of each building only
/// the errors of the meter that is foretold worst; ten rows of a list.
#include "report/stock_tables.hpp"

#include "base/terminal.hpp"
#include "report/text_table.hpp"
#include "stock/record.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <vector>

#include <fmt/format.h>

namespace bemcal::report {
namespace {

constexpr std::size_t most_buildings = 10;

/// First and last period of a building's meter.
struct Errors {
    std::string meter;
    double before = std::nan(""), training = std::nan(""), recent = std::nan("");
    double bias = std::nan("");
};

/// [buildings][meters]
std::vector<std::vector<Errors>> errors_by_meter(const Group& stock) {
    std::vector<std::vector<Errors>> errors(stock.texts("stock_building").size());
    const auto& of = stock.values("stock_fits_of");
    const auto& meters = stock.texts("stock_fit_meter");
    for (std::size_t k = 0; k < of.size(); ++k) {
        std::vector<Errors>& own = errors[of.index(k, errors.size())];
        auto error = std::ranges::find(own, meters[k], &Errors::meter);
        const double cv = stock.values("stock_fit_cv_rmse")[k];
        if (error == own.end())
            error = own.insert(
                own.end(), Errors{meters[k], stock.values("stock_fit_before")[k], cv});
        error->recent = cv;
        error->bias = stock.values("stock_fit_nmbe")[k];
    }
    return errors;
}

/// Of the meter with the largest error in the last period; of alike ones the first.
std::vector<Errors> errors_of(const Group& stock) {
    std::vector<Errors> worst;
    for (const std::vector<Errors>& meters : errors_by_meter(stock)) {
        const auto largest = std::ranges::max_element(meters, {}, [](const Errors& one) {
            return std::isfinite(one.recent) ? one.recent : -1;
        });
        worst.push_back(largest == meters.end() ? Errors{} : *largest);
    }
    return worst;
}

std::string number(double value) {
    return std::isfinite(value) ? fmt::format("{:.6g}", value) : "";
}

std::string counts_line(const Group& stock) {
    std::map<std::string, int> counts;
    for (const std::string& status : stock.texts("stock_status")) ++counts[status];
    std::string text = fmt::format("\n{}: buildings: {}", stock.path(),
                                   stock.texts("stock_status").size());
    for (const auto& [status, n] : counts) text += fmt::format(", {}: {}", status, n);
    const auto& drift = stock.texts("stock_drift");
    const auto n_drift = static_cast<std::ptrdiff_t>(drift.size()) -
                         std::ranges::count(drift, std::string());
    return text + fmt::format(", drifting: {}\n", n_drift);
}

/// The texts of a dataset that are not empty, with their buildings.
std::string list_of(const Group& stock, const char* title, const char* leaf) {
    const auto& names = stock.texts("stock_building");
    const auto& texts = stock.texts(leaf);
    TextTable table({title, ""});
    std::size_t n = 0;
    for (std::size_t k = 0; k < texts.size(); ++k)
        if (!texts[k].empty() && ++n <= most_buildings) table.add({names[k], texts[k]});
    if (n > most_buildings)
        table.add({"...", fmt::format("and {} more", n - most_buildings)});
    return table.is_empty() ? "" : "\n" + table.text(100);
}

std::string findings_list(const Group& stock) {
    const auto& of = stock.values("stock_findings_of");
    const auto& names = stock.texts("stock_building");
    TextTable table({"findings", "data", "finding", "done about it"});
    for (std::size_t k = 0; k < std::min(of.size(), 4 * most_buildings); ++k)
        table.add(
            {names[of.index(k, names.size())], stock.texts("stock_finding_series")[k],
             stock.texts("stock_finding")[k], stock.texts("stock_finding_action")[k]});
    return table.is_empty() ? "" : "\n" + table.text(50);
}

/// Effects in two buildings or more.
std::string common_list(const Group& stock) {
    if (!stock.has("stock_common_effect")) return "";
    const auto& names = stock.texts("stock_common_effect");
    const auto& n = stock.values("stock_common_n");
    const auto value = [&](const char* leaf, std::size_t k) {
        return fmt::format("{:.3g}", stock.values(leaf)[k]);
    };
    TextTable table({"in common", "buildings", "coefficient", "middle half", "unit"});
    for (std::size_t k = 0; k < std::min(names.size(), most_buildings); ++k)
        if (n[k] > 1)
            table.add(
                {names[k],
                 fmt::format("in {:.0f} of {:.0f}", n[k],
                             stock.values("stock_common_of")[k]),
                 value("stock_common_median", k),
                 value("stock_common_q25", k) + " to " + value("stock_common_q75", k),
                 stock.texts("stock_common_unit")[k]});
    return table.is_empty() ? "" : "\n" + table.text(60);
}

std::string worst_list(const Group& stock) {
    const auto errors = errors_of(stock);
    std::vector<std::size_t> order(errors.size());
    std::iota(order.begin(), order.end(), 0U);
    std::erase_if(order, [&](std::size_t k) { return !std::isfinite(errors[k].recent); });
    std::ranges::stable_sort(order, std::greater(),
                             [&](std::size_t k) { return errors[k].recent; });
    TextTable table({"worst", "meter", "CV(RMSE) as it started", "calibrated",
                     "last period", "NMBE there"});
    for (std::size_t k = 0; k < std::min(order.size(), most_buildings); ++k) {
        const Errors& error = errors[order[k]];
        table.add({stock.texts("stock_building")[order[k]], error.meter,
                   percent(error.before), percent(error.training), percent(error.recent),
                   percent(error.bias)});
    }
    return table.is_empty() ? "" : "\n" + table.text(30);
}

}  // namespace

std::string csv_cell(const std::string& text) {
    std::string line = in_one_line(text);
    if (line != "-" && line.find_first_of("=+-@") == line.find_first_not_of(' ') &&
        !line.empty() && line.find_first_not_of(' ') != std::string::npos)
        line.insert(0, "'");
    if (line.find_first_of(",\"") == std::string::npos) return line;
    std::string quoted = "\"";
    for (const char c : line) quoted += c == '"' ? "\"\"" : std::string(1, c);
    return quoted + "\"";
}

std::string stock_section(const Group& stock) {
    return counts_line(stock) + list_of(stock, "failed", "stock_reason") +
           list_of(stock, "changed", "stock_told") + common_list(stock) +
           list_of(stock, "drifting", "stock_drift") + worst_list(stock) +
           findings_list(stock);
}

std::string stock_csv(const Group& stock) {
    std::string text = stock::table_head;
    const auto errors = errors_of(stock);
    std::vector<std::string> findings(errors.size());
    const auto& of = stock.values("stock_findings_of");
    for (std::size_t k = 0; k < of.size(); ++k) {
        std::string& all = findings[of.index(k, findings.size())];
        all += fmt::format("{}{}: {}: {}", all.empty() ? "" : "; ",
                           stock.texts("stock_finding_series")[k],
                           stock.texts("stock_finding")[k],
                           stock.texts("stock_finding_action")[k]);
    }
    for (std::size_t k = 0; k < errors.size(); ++k) {
        for (const char* leaf : {"stock_building", "stock_status", "stock_cause",
                                 "stock_reason", "stock_drift"})
            text += csv_cell(stock.texts(leaf)[k]) + ",";
        const Errors& error = errors[k];
        text += fmt::format(
            "{},{},{},{},{},{},{},{}\n", number(stock.values("stock_age")[k]),
            number(stock.values("stock_simulations")[k]), csv_cell(error.meter),
            number(error.before), number(error.training), number(error.recent),
            number(error.bias), csv_cell(findings[k]));
    }
    return text;
}

std::string stock_changes(const Group& stock) {
    std::string text = stock::changes_head;
    if (!stock.has("stock_told")) return text;
    constexpr std::string_view between = "; ", behind_kind = ": ";
    const auto& told = stock.texts("stock_told");
    for (std::size_t k = 0; k < told.size(); ++k)
        for (std::size_t at = 0; at < told[k].size();) {
            const std::size_t end = std::min(told[k].find(between, at), told[k].size());
            const std::string one = told[k].substr(at, end - at);
            const std::size_t kind = std::min(one.find(behind_kind), one.size());
            text += fmt::format(
                "{},{},{},{}\n", csv_cell(stock.texts("stock_building")[k]),
                csv_cell(one.substr(0, kind)),
                csv_cell(one.substr(std::min(kind + behind_kind.size(), one.size()))),
                number(stock.values("stock_searches")[k]));
            at = end + between.size();
        }
    return text;
}

std::string stock_history(const Group& stock, const std::string& night) {
    std::string text;
    const auto errors = errors_of(stock);
    for (std::size_t k = 0; k < errors.size(); ++k)
        text +=
            fmt::format("{},{},{},{},{},{},{},{},{}\n", csv_cell(night),
                        csv_cell(stock.texts("stock_building")[k]),
                        csv_cell(stock.texts("stock_status")[k]),
                        csv_cell(stock.texts("stock_cause")[k]),
                        number(errors[k].training), number(errors[k].recent),
                        number(errors[k].bias), csv_cell(stock.texts("stock_drift")[k]),
                        csv_cell(stock.texts("stock_reason")[k]));
    return text;
}

}  // namespace bemcal::report
