/// Lays what effects leave to functions, and searches for effects once more in what
/// functions leave.
/// What decides are unseen readings. Candidates without a name take no part beside
/// functions.
#include "loop/beside_functions.hpp"

#include "effects/catalogue.hpp"
#include "loop/decisions.hpp"
#include "loop/effect_search.hpp"
#include "loop/find_functions.hpp"
#include "loop/gates.hpp"
#include "loop/moves.hpp"

#include <optional>
#include <utility>

namespace bemcal::loop {
namespace {

/// The model as it stands, without its functions; nothing where it needs them.
std::optional<Standing> without_functions(const LoopData& data, const Place& place,
                                          Standing last) {
    last.built = build(place, last.model.effects);
    last.fit.at = {last.fit.at.x, {}, {}};
    refit(data, last, only_derivatives);
    if (last.fit.failed) return std::nullopt;
    return last;
}

/// What a search sees where functions have taken the misfit: readings less what functions
/// bring to them, and the last model without functions. Candidates without a name are
/// left to functions, and so are hours: a function of the hour has taken them.
struct BesideFunctions {
    LoopData data;
    LoopResult result;
};

/// Nothing where the model needs its functions to be simulated.
std::optional<BesideFunctions> beside_functions(const LoopData& data, const Place& place,
                                                const LoopResult& result) {
    BesideFunctions beside{data, result};
    beside.data.options.generic = false;
    beside.data.options.exclude.emplace_back(effects::name_of_other_hours);
    beside.result.baseline.place = place;
    auto without = without_functions(data, place, result.last);
    if (!without) return std::nullopt;
    Standing& last = beside.result.last = std::move(*without);
    for (std::size_t k = 0; k < data.targets.size(); ++k)
        beside.data.targets.measured[k] -=
            result.last.fit.at.predicted[k] - last.fit.at.predicted[k];
    settle(beside.data, last);
    return beside;
}

/// Finds functions about result.last as it is without any; it has them then.
/// \param place  without functions
void lay_rest_to_functions(const LoopData& data, const Place& place, LoopResult& result) {
    result.baseline.place = place;
    result.functions = find_functions(data, result.baseline.place, result.last);
}

/// By how much the deviance of unseen readings falls from one result to another.
double foretells_more(const LoopData& data, const LoopResult& one,
                      const LoopResult& other) {
    const auto score_of = [&](const LoopResult& result) {
        return deviance(data.targets, one.last.noise, result.last.left_out);
    };
    return score_of(one) - score_of(other);
}

/// \param place  without functions
void search_beside_functions(const LoopData& data, const Place& place, LoopResult& result,
                             UnderWay& under_way) {
    const auto most = static_cast<std::size_t>(data.options.most_effects);
    while (!result.functions.empty() && result.last.model.effects.size() < most) {
        under_way.begin("effects beside functions");
        auto beside = beside_functions(data, place, result);
        if (!beside) return;
        LoopResult& tried = beside->result;
        tried.log.push_back({"", "functions join; once more beside them"});
        const bool is_added = add_effect_beside_functions(beside->data, tried, under_way);
        result.log = tried.log;
        if (!is_added) return;
        settle(data, tried.last);
        if (tried.last.fit.failed) return;
        lay_rest_to_functions(data, place, tried);
        const double gained = foretells_more(data, result, tried);
        tried.log.push_back({tried.last.model.effects.back().name,
                             gained > 0
                                 ? "stays: both foretell more than functions did"
                                 : "taken out: functions foretell as much without it",
                             0, 0, gained});
        if (gained <= 0) {
            result.log = tried.log;
            return;
        }
        tried.candidates = result.candidates;
        result = std::move(tried);
    }
}

/// Effects leave, those that joined last first, without which functions foretell unseen
/// readings better by more than a part of their evidence: a name is worth that part.
void leave_to_functions(const LoopData& data, const Place& place, LoopResult& result) {
    auto alone = without_functions(data, place, result.last);
    for (std::size_t k = result.last.model.effects.size(); alone && k-- > 0;) {
        LoopResult tried = result;
        tried.last = *alone;
        const auto gone = take_out(data, place, tried.last, k);
        if (!gone) continue;
        lay_rest_to_functions(data, place, tried);
        const double gained = foretells_more(data, result, tried);
        if (gained <= (1 - decisions::share_foretold) * result.found[k].gain) continue;
        tried.found.erase(tried.found.begin() + static_cast<std::ptrdiff_t>(k));
        tried.log.push_back(
            {gone->name, "taken out: functions foretell more without it", 0, 0, gained});
        result = std::move(tried);
        alone = without_functions(data, place, result.last);
    }
}

}  // namespace

void search_functions(const LoopData& data, LoopResult& result, UnderWay& under_way) {
    const Place without = result.baseline.place;
    under_way.begin("functions");
    lay_rest_to_functions(data, without, result);
    search_beside_functions(data, without, result, under_way);
    leave_to_functions(data, without, result);
}

}  // namespace bemcal::loop
