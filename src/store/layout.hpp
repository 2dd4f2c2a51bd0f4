/// What a result may hold: ONE table of dataset names, dimensions, units and meanings.
///
/// A dataset is known by the last part of its path, or, where the user named it (an
/// unknown, a meter), by its group: "posterior/*". The groups posterior, sample_stats,
/// prior, observed_data and posterior_predictive are ArviZ's InferenceData
/// (https://python.arviz.org/en/stable/schema/schema.html), with dimensions chain and
/// draw. The writer takes `units` and `long_name` from here, `describe results` prints
/// it, and a dataset that is not in it is a program error.
#pragma once

#include "study/stage.hpp"

#include <span>
#include <string>

namespace bemcal::store {

enum class Kind { number, text };

struct LayoutRow {
    const char* leaf;  ///< or "group/*"; a name that ends with * stands for all such
    const char* dims;  ///< names, separated by spaces; "" = a single value
    Kind kind;
    const char* unit;  ///< "" for texts
    const char* meaning;
};

std::span<const LayoutRow> layout();

/// The row of a dataset. Throws std::logic_error where its name is unknown, or its
/// dimensions or kind are not those of the table.
const LayoutRow& layout_of(const study::Dataset& dataset);

/// The same for a result that may be of another program or damaged: nullptr where its
/// name is unknown.
const LayoutRow* known_layout(const study::Dataset& dataset);
/// Whether dimensions and kind are those of the row.
bool is_as(const study::Dataset& dataset, const LayoutRow& row);

/// The table as text, for `describe results`.
std::string describe_results();

}  // namespace bemcal::store
