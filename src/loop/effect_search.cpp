/// Adds effects to a building's model, one after the other, until nothing passes; then
/// refinements leave that they have made needless.
/// A step is left to `search`, its gates to `objection_to`, moves to `moves`.
#include "loop/effect_search.hpp"

#include "effects/catalogue.hpp"
#include "loop/decisions.hpp"
#include "loop/moves.hpp"
#include "loop/rivals.hpp"
#include "loop/search.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace bemcal::loop {
namespace {

/// A term of the grammar is called by what it says.
std::string label_of(const effects::Effect& effect) {
    return effect.is_named() ? effect.name + ": " + effects::sentence_of(effect)
                             : effect.name;
}

void log_step(const Step& step, std::vector<LoggedStep>& log) {
    for (std::size_t k = 0; k < step.ranking.size() && k < 8; ++k) {
        const Refitted& candidate = step.ranking[k];
        const bool chosen = static_cast<int>(k) == step.chosen;
        if (!chosen && step.chosen >= 0 && static_cast<int>(k) > step.chosen) break;
        log.push_back({label_of(candidate.effect),
                       chosen ? "accepted" : candidate.objection, candidate.gain,
                       step.threshold, candidate.score, candidate.error});
    }
}

class Search {
  public:
    Search(const LoopData& data, LoopResult& result, UnderWay& under_way,
           bool may_set_clock)
        : data_(data),
          result_(result),
          under_way_(under_way),
          may_set_clock_(may_set_clock) {}

    void run() {
        const Place& place = result_.baseline.place;
        const auto most = static_cast<std::size_t>(data_.options.most_effects);
        // What is accepted may leave again, and must not come and go for ever.
        for (std::size_t step = 0; step < decisions::rounds_per_effect * most; ++step) {
            under_way_.begin("effect", static_cast<int>(step) + 1);
            if (result_.last.model.effects.size() >= most ||
                !accept_one(place, decisions::least_probability_to_join))
                break;
        }
        if (late_clock_) return;
        under_way_.begin("what effects leave open");
        if (result_.last.model.effects.size() >= most)
            result_.log.push_back({"", "as many effects as were asked for"});
        else
            note_misfit();
        note_what_shapes_leave_open(place);
        leave_unneeded_structure();
        if (!result_.found.empty() &&
            spare_meters(data_, result_.baseline.chosen, result_.last))
            result_.log.push_back(
                {"last fit", "meters that were explained worse count more"});
    }

    /// One more effect, where functions have taken the model's misfit. Says whether one
    /// joined whose evidence and name leave no doubt: what is small is left to functions,
    /// which can say it with as little.
    bool add_beside_functions() {
        const std::size_t n_before = result_.found.size();
        if (!accept_one(result_.baseline.place, decisions::told_probability) ||
            result_.found.size() <= n_before)
            return false;
        Found& newest = result_.found.back();
        if (!tells_beside_functions(newest)) {
            result_.log.push_back(
                {result_.last.model.effects.back().name,
                 "taken out: beside functions its evidence is less than "
                 "three times what noise shows"});
            return false;
        }
        if (newest.doubt.empty()) newest.doubt = "it is seen only beside functions";
        return true;
    }

    /// What ended the search: all of it is to be done again by the right hour.
    const std::optional<LateClock>& late_clock() const { return late_clock_; }

  private:
    /// \param least_probability  of its name
    bool accept_one(const Place& place, double least_probability) {
        Step step = search(data_, place, result_.last, barred_);
        log_step(step, result_.log);
        threshold_ = step.threshold;
        result_.candidates.clear();
        for (const Refitted& candidate : step.ranking)
            if (!candidate.objection.empty())
                result_.candidates.emplace_back(label_of(candidate.effect),
                                                candidate.gain);
        if (step.chosen < 0) {
            result_.log.push_back({"", "nothing passes", 0, step.threshold});
            note_what_moves(step);
            return false;
        }
        const EffectClass near = class_of(data_, result_.last, step);
        result_.undecided.clear();
        if (near.probability() < least_probability) {
            result_.undecided = near.names;
            result_.log.push_back(
                {near.names.front().name,
                 fmt::format("does not join: its probability is {:.2f}, "
                             "{:.1f} is asked",
                             near.probability(), least_probability),
                 0, step.threshold});
            return false;
        }
        Refitted& chosen = step.ranking[static_cast<std::size_t>(step.chosen)];
        const std::string doubt = doubt_of(chosen, near);
        result_.found.push_back(
            {near.names, doubt, chosen.gain, step.threshold, near.rivals});
        const double before = alarm_of(data_, place, result_.last, chosen.effect);
        const std::size_t newest = chosen.standing.model.effects.size() - 1;
        const std::string name = chosen.effect.name;
        result_.last = refine_shape(data_, place, std::move(chosen.standing), newest);
        if (start_again(data_, place, result_.last)) {
            result_.log.push_back({name, "calibrated anew with it"});
            result_.last = refine_shape(data_, place, std::move(result_.last), newest);
        }
        if (may_set_clock_ && result_.hours_late == 0)
            late_clock_ = late_clock_in_place_of(data_, result_.last, newest);
        if (late_clock_) return false;
        const double needed = decisions::share_of_threshold * step.threshold;
        const bool is_split = split(data_, place, result_.last, newest, needed);
        if (doubt.empty() && !is_over(before, alarm_left(place, newest, chosen.effect)))
            result_.found.back().doubt = "the pattern that pointed to it is still there";
        if (is_split) note_split(newest);
        swap_earlier(place);
        drop(prune(data_, place, result_.last, needed),
             "taken out again: no longer needed");
        drop(prune_implausible(data_, place, result_.last),
             "taken out again: coefficient no longer plausible");
        bar_if_gone(name);
        return true;
    }

    /// Why an effect's name may be the nearest one only, before its alarm is looked at.
    std::string doubt_of(const Refitted& chosen, const EffectClass& near) const {
        if (!chosen.effect.is_named()) return "it says where and when, not why";
        if (near.probability() < decisions::told_probability)
            return "its probability is below 0.9";
        if (data_.reads_months_only()) return "months cannot show that nothing is left";
        return "";
    }

    /// The alarm that an effect leaves where it has joined: with the shape in which it
    /// was found, and with the one that it has now; its coefficient is held for that, or
    /// it would follow itself.
    double alarm_left(const Place& place, std::size_t effect,
                      const effects::Effect& as_found) const {
        Standing held = result_.last;
        held.fit.bound[held.built.first_effect() + effect] = 1;
        return std::max(alarm_of(data_, place, result_.last, as_found),
                        alarm_of(data_, place, held, held.model.effects[effect]));
    }

    /// What has just joined and left again would be found next, from the same model.
    void bar_if_gone(const std::string& name) {
        if (std::ranges::none_of(result_.last.model.effects,
                                 [&](const auto& effect) { return effect.name == name; }))
            barred_.push_back(name);
    }

    /// What is still missing would move the coefficients: so far as candidates do that
    /// more than noise speaks for, though none passes.
    void note_what_moves(const Step& last) {
        for (std::size_t k = 0; k < result_.found.size(); ++k) {
            double squares = 0, n = 0;
            for (const Refitted& candidate : last.ranking) {
                if (candidate.gain <= last.threshold) continue;
                squares += std::pow(
                    candidate.standing.coefficient(k) - result_.last.coefficient(k), 2);
                n += 1;
            }
            result_.found[k].of_missing = n > 0 ? std::sqrt(squares / n) : 0;
        }
    }

    /// A model that is not the building leaves a residual that terms of the catalogue and
    /// the grammar can take a part of: so much more than noise shows.
    void note_misfit() {
        if (!result_.candidates.empty() && threshold_ > 0)
            result_.misfit = std::max(1.0, result_.candidates[0].second / threshold_);
    }

    void leave_unneeded_structure() {
        if (result_.found.empty()) return;
        for (const std::size_t refinement :
             leave_unneeded_refinements(data_, result_.baseline.place, result_.last))
            result_.log.push_back({effects::refinements()[refinement].name,
                                   "taken out of the structure: no longer needed"});
    }

    void note_what_shapes_leave_open(const Place& place) {
        for (std::size_t k = 0; k < result_.found.size(); ++k)
            result_.found[k].of_shape =
                deviation_over_shapes(data_, place, result_.last, k, result_.misfit);
    }

    void note_split(std::size_t effect) {
        const auto& all = result_.last.model.effects;
        Found& plant = result_.found[effect];
        plant.rivals.clear();
        plant.names = {{all[effect].name, plant.names.front().probability}};
        Found use = plant;
        use.names.front().name = all.back().name;
        result_.log.push_back({all.back().name, "split from the plant's"});
        result_.found.push_back(std::move(use));
    }

    /// What was found first may have stood for what has joined since.
    void swap_earlier(const Place& place) {
        for (std::size_t k = 0; k + 1 < result_.found.size(); ++k) {
            Found& found = result_.found[k];
            const std::string was = result_.last.model.effects[k].name;
            const int rival = swap(data_, place, result_.last, k, found.rivals);
            if (rival < 0) continue;
            const effects::Effect& now = result_.last.model.effects[k];
            result_.log.push_back({label_of(now), "in place of " + was});
            found.names = {{now.name, 0.5}, {was, 0.5}};  // each has been the best
            found.doubt = "it stands in the place of another";
        }
    }

    /// Forgets what was said of effects that have left.
    void drop(const std::vector<Gone>& all, const char* why) {
        for (const Gone& gone : all) {
            result_.log.push_back({gone.name, why});
            result_.found.erase(result_.found.begin() +
                                static_cast<std::ptrdiff_t>(gone.index));
        }
        name_halves_as_wholes();
    }

    /// A half that stands for both again has the whole's name.
    void name_halves_as_wholes() {
        for (std::size_t k = 0; k < result_.found.size(); ++k) {
            const std::string& name = result_.last.model.effects[k].name;
            auto& said = result_.found[k].names;
            if (said.size() == 1 && said.front().name == name + suffix_of_use)
                said.front().name = name;
        }
    }

    const LoopData& data_;
    LoopResult& result_;
    UnderWay& under_way_;
    bool may_set_clock_;
    double threshold_ = 0;  ///< of the last step
    std::optional<LateClock> late_clock_;
    std::vector<std::string> barred_;
};

}  // namespace

std::optional<LateClock> search_effects(const LoopData& data, LoopResult& result,
                                        UnderWay& under_way, bool may_set_clock) {
    Search search(data, result, under_way, may_set_clock);
    search.run();
    return search.late_clock();
}

bool tells_beside_functions(const Found& found) {
    return found.gain >= decisions::least_beside_functions * found.needed;
}

bool add_effect_beside_functions(const LoopData& data, LoopResult& result,
                                 UnderWay& under_way) {
    return Search(data, result, under_way, false).add_beside_functions();
}

}  // namespace bemcal::loop
