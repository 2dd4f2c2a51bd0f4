/// Holds the table of quantities to its enums, and lists carriers for messages.
/// Plain bookkeeping without a source.
/// What meters show is left to meters.
#include "physics/quantities.hpp"

namespace bemcal::physics {
namespace {

constexpr bool rows_stand_in_order() {
    for (std::size_t k = 0; k < n_quantities; ++k)
        if (quantity_rows[k].quantity != static_cast<Quantity>(k)) return false;
    return true;
}
static_assert(rows_stand_in_order(), "quantity_rows has another order than Quantity");
static_assert(std::ranges::count(carrier_names, nullptr) == 0,
              "a Carrier has no row in quantity_rows, or two have the same");

}  // namespace

std::string nouns_of_carriers() {
    std::string text;
    std::size_t left = carrier_names.size() - 1;
    for (const QuantityRow& row : quantity_rows) {
        if (row.carrier == Carrier::none) continue;
        text += row.noun;
        if (--left > 0) text += left > 1 ? ", " : " or ";
    }
    return text;
}

}  // namespace bemcal::physics
