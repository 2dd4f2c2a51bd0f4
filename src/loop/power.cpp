/// Says before the search what the data could show of each effect at its typical size:
/// how well it is seen, what looks like it, which parameter it would bias.
/// Follows from the tangent of the calibrated model (`screen`), all else free.
/// Leaves out two effects at once, and shapes after the first that moves a meter.
#include "loop/power.hpp"

#include "effects/catalogue.hpp"
#include "loop/decisions.hpp"

#include <algorithm>
#include <cmath>

namespace bemcal::loop {
namespace {

/// An effect of the catalogue in all its shapes and places: a row of the table.
struct Row {
    std::string name;
    std::vector<effects::Effect> variants;
    Screened screened{};
    bool is_seen = false;  ///< at a meter
};

std::vector<Row> rows_of(const LoopData& data, const Place& place) {
    std::vector<Row> rows;
    const auto all = effects::named_candidates(*place.surroundings, data.quantities());
    for (const effects::Effect& effect : all) {
        const auto row = std::ranges::find_if(rows, [&](const Row& there) {
            return are_of_one_row(there.variants[0], effect);
        });
        if (row == rows.end())
            rows.push_back({"", {effect}});
        else
            row->variants.push_back(effect);
    }
    return rows;
}

/// An effect that several meters could show has the meter's name, too.
void name_by_meters(std::vector<Row>& rows) {
    for (Row& row : rows) {
        const effects::Effect& first = row.variants[0];
        const auto n = std::ranges::count_if(
            rows, [&](const Row& other) { return other.variants[0].name == first.name; });
        row.name = n > 1 ? first.name + " (" + first.place_name + ")" : first.name;
    }
}

/// The rows that move a meter, each by the first of its variants that does.
std::vector<Row> one_of_each(const LoopData& data, const Place& place,
                             const Standing& standing) {
    std::vector<Row> rows = rows_of(data, place);
    std::vector<effects::Effect> tried;
    for (std::size_t variant = 0; variant == 0 || !tried.empty(); ++variant) {
        tried.clear();
        for (const Row& row : rows)
            if (!row.is_seen && variant < row.variants.size())
                tried.push_back(row.variants[variant]);
        for (Screened& screened :
             screen(data, place, standing, tried, Keep::of_typical)) {
            const auto row = std::ranges::find_if(rows, [&](const Row& there) {
                return are_of_one_row(there.variants[0], screened.effect);
            });
            row->screened = std::move(screened);
            row->is_seen = true;
        }
    }
    std::erase_if(rows, [](const Row& row) { return !row.is_seen; });
    name_by_meters(rows);
    return rows;
}

void find_alias(std::size_t row, PowerTable& table) {
    Power& power = table.rows[row];
    if (is_in_parameters(power)) {
        power.alias = effects::same_as(power.effect);
        power.alias_kind = AliasKind::same;
        power.correlation = 1;
        if (!power.alias.empty()) return;
        power.alias = words_of_parameters;
        power.alias_kind = AliasKind::parameters;
        power.correlation = std::sqrt(1 - power.visibility);
        return;
    }
    for (std::size_t other = 0; other < table.rows.size(); ++other) {
        if (other == row) continue;
        const double rho = correlation_of(table.screened[row].signature,
                                          table.screened[other].signature, table.weights);
        if (std::abs(rho) <= std::abs(power.correlation)) continue;
        power.correlation = rho;
        power.alias = table.rows[other].name;
        power.alias_kind = AliasKind::effect;
    }
}

void find_bias(const Standing& standing, const Screened& screened, Power& power) {
    for (std::size_t k = 0; k < screened.bias.size(); ++k)
        if (std::abs(screened.bias[k]) > std::abs(power.bias)) {
            power.bias = screened.bias[k];
            power.parameter = standing.built.unknowns[k].name;
        }
}

}  // namespace

const char* name_of(AliasKind kind) {
    switch (kind) {
        case AliasKind::effect:
            return "effect";
        case AliasKind::same:
            return "same";
        case AliasKind::parameters:
            return "parameters";
        case AliasKind::none:
            break;
    }
    return "";
}

bool are_of_one_row(const effects::Effect& a, const effects::Effect& b) {
    return a.name == b.name && (!effects::is_at_a_meter(a.hook) || a.meter == b.meter);
}

bool is_in_parameters(const Power& power) {
    constexpr double same = decisions::same_signature;
    return power.visibility < 1 - same * same;
}

bool can_be_seen(const Power& power) {
    return power.detectability >= decisions::least_detectability;
}

double correlation_of(std::span<const double> a, std::span<const double> b,
                      std::span<const double> weights) {
    double ab = 0, aa = 0, bb = 0;
    for (std::size_t k = 0; k < a.size(); ++k) {
        ab += weights[k] * a[k] * b[k];
        aa += weights[k] * a[k] * a[k];
        bb += weights[k] * b[k] * b[k];
    }
    return aa > 0 && bb > 0 ? ab / std::sqrt(aa * bb) : 0;
}

PowerTable power_of(const LoopData& data, const Place& place, const Standing& standing) {
    PowerTable table;
    table.weights = weights_of(data.targets, standing.noise);
    for (Row& row : one_of_each(data, place, standing)) {
        const Screened& screened = table.screened.emplace_back(std::move(row.screened));
        Power power{std::move(row.name), screened.effect};
        power.detectability =
            std::abs(screened.effect.typical) * std::sqrt(screened.information);
        power.visibility = screened.visibility;
        find_bias(standing, screened, power);
        table.rows.push_back(std::move(power));
    }
    for (std::size_t row = 0; row < table.rows.size(); ++row) find_alias(row, table);
    return table;
}

}  // namespace bemcal::loop
