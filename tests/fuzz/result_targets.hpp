/// What the fuzzers and tests of damaged results throw datasets at: every reader of a
/// result, where the only way out besides an answer is a UserError.
#pragma once

#include "base/error.hpp"
#include "fuzz/choices.hpp"
#include "report/merge_chains.hpp"
#include "report/stock_tables.hpp"
#include "report/tables.hpp"
#include "stock/record.hpp"
#include "stock/shared.hpp"
#include "store/dataset_path.hpp"
#include "store/layout.hpp"
#include "store/layout_check.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace bemcal::fuzz {

/// \return the UserError's message, or ""
template <class Read>
std::string refusal_of(Read&& read) {
    try {
        read();
        return "";
    } catch (const UserError& error) {
        return error.what();
    }
}

/// As `--after` takes it.
inline void try_night(const store::ResultFile& result) {
    store::check_layout(result);
    auto records = stock::records_in(result.datasets);
    stock::find_shared_meters(records);
}

/// \return the messages
inline std::vector<std::string> try_result(const store::ResultFile& result) {
    std::vector<std::string> refusals;
    const auto attempt = [&](auto&& read) { refusals.push_back(refusal_of(read)); };
    attempt([&] { report::tables_of(result); });
    attempt([&] { report::status_of(result); });
    attempt([&] {
        store::ResultFile other = result;
        other.attributes["first_chain"] = "99999999999999999999";
        for (const store::ResultFile& merged : report::merge_chains({result, other}))
            report::tables_of(merged);
    });
    for (const report::Group& stock : report::groups_with(result, "stock_building")) {
        attempt([&] { report::stock_csv(stock); });
        attempt([&] { report::stock_history(stock, "night"); });
    }
    attempt([&] { try_night(result); });
    std::erase(refusals, "");
    return refusals;
}

/// Fills or cuts the values to the shape.
inline void fit_to_shape(study::Dataset& dataset, bool has_texts, double value) {
    std::size_t n = 1;
    for (const std::size_t size : dataset.shape) n *= size;
    dataset.values.resize(has_texts ? 0 : n, value);
    dataset.texts.resize(has_texts ? n : 0, std::to_string(value));
}

/// One dataset becomes another, still of as many values as its shape says.
inline void damage(study::Dataset& dataset, Choices& choices) {
    static const double numbers[] = {
        0,    1,      2,        3,         -1,     0.5,
        1e9,  1e18,   1e75,     1e300,     -1e300, std::nan(""),
        4096, 5e-324, HUGE_VAL, -HUGE_VAL, 1e-9};
    static const std::size_t sizes[] = {0, 1, 2, 3, 5, 8, 24, 200};
    const double value = choices.one_of(numbers);
    const bool has_texts = !dataset.texts.empty();
    switch (choices.below(6)) {
        case 0:
            if (dataset.shape.empty()) return;
            choices.one_of(dataset.shape) = choices.one_of(sizes);
            return fit_to_shape(dataset, has_texts, value);
        case 1:
            std::ranges::fill(dataset.values, value);
            std::ranges::fill(dataset.texts, std::to_string(value));
            return;
        case 2:
            if (!dataset.values.empty()) choices.one_of(dataset.values) = value;
            if (!dataset.texts.empty()) choices.one_of(dataset.texts) = "degC; \x1b[31m";
            return;
        case 3:
            return fit_to_shape(dataset, !has_texts, value);
        case 4: {
            const auto rows = store::layout();
            const store::LayoutRow& row = choices.one_of(rows);
            dataset.path = store::group_of(dataset.path) + "/" + row.leaf;
            return;
        }
        default:
            if (dataset.dims.empty()) return;
            choices.one_of(dataset.dims) = store::leaf_of(dataset.path);
    }
}

inline void damage(store::ResultFile& result, Choices& choices) {
    for (int n = 0; n < 12 && !choices.is_over() && !result.datasets.empty(); ++n) {
        const std::size_t k = choices.below(result.datasets.size());
        if (choices.below(8) == 0)
            result.datasets.erase(result.datasets.begin() +
                                  static_cast<std::ptrdiff_t>(k));
        else
            damage(result.datasets[k], choices);
    }
}

}  // namespace bemcal::fuzz
