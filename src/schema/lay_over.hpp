/// A description with what another text says of it.
#pragma once

#include "schema/document.hpp"

namespace bemcal::schema {

/// Puts the tables of `over` into `base`: a list's table of a name that base has takes
/// its keys, others are appended; any other key of the root is replaced.
void lay_over(const Node& over, Node& base);

/// The value at a key of a table; nullptr where it has none.
const Node* find_node(const Node& table, std::string_view key);

}  // namespace bemcal::schema
