/// Before the search: what these data could show at all.
#pragma once

#include "loop/search.hpp"

namespace bemcal::loop {

/// What looks like an effect.
enum class AliasKind {
    none,       ///< nothing else is there
    effect,     ///< another one of the table
    same,       ///< a parameter that is the same in every reading
    parameters  ///< other values of what is calibrated do nearly what it does
};
const char* name_of(AliasKind kind);
/// As an alias.
inline constexpr const char* words_of_parameters = "the calibrated parameters themselves";

/// One effect of the catalogue at its typical size.
struct Power {
    std::string name;  ///< of the effect; of what one of several meters shows, with it
    effects::Effect effect;
    double detectability = 0;  ///< its size over what it can be known to
    double visibility = 0;     ///< share that the other unknowns cannot follow
    std::string alias{};       ///< what looks most like it, in words
    AliasKind alias_kind = AliasKind::none;
    double correlation = 0;   ///< of both signatures
    std::string parameter{};  ///< that it would bias most
    double bias = 0;          ///< [prior sd]
};

struct PowerTable {
    std::vector<Power> rows;
    std::vector<Screened> screened;  ///< [rows] with signatures
    std::vector<double> weights;     ///< of the readings
};
/// Whether one row stands for both: what enters at one meter the others do not see.
bool are_of_one_row(const effects::Effect& a, const effects::Effect& b);
/// Whether other values of the parameters do nearly what the effect does.
bool is_in_parameters(const Power& power);
/// Whether there would be more of it than it can be known to.
bool can_be_seen(const Power& power);
PowerTable power_of(const LoopData& data, const Place& place, const Standing& standing);

/// Correlation of two signatures in the weights' metric.
double correlation_of(std::span<const double> a, std::span<const double> b,
                      std::span<const double> weights);

}  // namespace bemcal::loop
