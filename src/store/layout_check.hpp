/// Whether a result that may be of anyone is laid out as ours are.
#pragma once

#include "store/result.hpp"

#include <string>

namespace bemcal::store {

/// Throws UserError: "damaged: dataset PATH has shape (3), and WHY".
/// \param dataset  nullptr = it is missing
[[noreturn]] void refuse_dataset(const study::Dataset* dataset, const std::string& path,
                                 const std::string& why);

/// Whether each dataset is as the layout has it, and as long as the names of its
/// dimensions. Throws UserError where one is not; unknown ones are passed over.
void check_layout(const ResultFile& result);

}  // namespace bemcal::store
