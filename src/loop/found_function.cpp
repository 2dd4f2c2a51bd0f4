/// Says where a function enters and what it follows.
/// Follows from its hook and its basis. Its shape is not put into words.
#include "loop/found_function.hpp"

#include <fmt/format.h>

namespace bemcal::loop {

std::string name_of(const FoundFunction& function) {
    if (function.basis.driver == "one") return function.at.name;
    return fmt::format("{} by {}", function.at.name, function.basis.driver);
}

}  // namespace bemcal::loop
