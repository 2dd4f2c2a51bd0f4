/// Functions beside effects: what is left is laid to them, and where they have taken the
/// model's misfit, effects are searched once more.
#pragma once

#include "loop/results.hpp"
#include "loop/under_way.hpp"

namespace bemcal::loop {

/// Finds functions about result.last as it is without any, which has them then, and
/// effects beside the functions. A model's misfit hides what is small, and
/// functions take the misfit: beside them effects with a name are searched once more. One
/// that passes joins the model without functions, which are found again. All of it stays
/// if it foretells unseen readings better than the functions that were there. At last
/// effects leave without which functions foretell clearly more.
void search_functions(const LoopData& data, LoopResult& result, UnderWay& under_way);

}  // namespace bemcal::loop
