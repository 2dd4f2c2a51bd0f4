/// Searches each building for effects that its description lacks: one after the other
/// joins until nothing passes; then those leave that do not stand out.
/// Source: Efron 2004 (JASA 99), the empirical null, for what stands out.
/// A step is left to `search`, its gates to `objection_to`. Periods other than training
/// are only reported.
#include "loop/loop.hpp"

#include "effects/catalogue.hpp"
#include "loop/find_functions.hpp"
#include "loop/intervals.hpp"
#include "loop/late_clock.hpp"
#include "loop/loads.hpp"
#include "loop/moves.hpp"
#include "loop/results.hpp"
#include "loop/rivals.hpp"
#include "loop/search_building.hpp"
#include "study/packed_conclusion.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iterator>
#include <stdexcept>

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

constexpr const char* nearly_nothing = "left: its coefficient may be nearly nothing";

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
        for (std::size_t step = 0; step < 3 * most; ++step) {
            under_way_.begin("effect", static_cast<int>(step) + 1);
            if (result_.last.model.effects.size() >= most || !accept_one(place)) break;
        }
        if (late_clock_) return;
        under_way_.begin("effects that do not stand out");
        if (result_.last.model.effects.size() >= most)
            result_.log.push_back({"", "as many effects as were asked for", 0, 0, 0, {}});
        else
            leave_what_does_not_stand_out(place);
        while (leave_least_certain(place)) {
        }
        if (!result_.found.empty() &&
            spare_meters(data_, result_.baseline.chosen, result_.last))
            result_.log.push_back(
                {"last fit", "meters that were explained worse count more", 0, 0, 0, {}});
    }

    /// One more effect, where functions have taken the model's misfit. Says whether one
    /// joined whose coefficient is certain.
    bool add_beside_functions() {
        const std::size_t n_before = result_.found.size();
        if (!accept_one(result_.baseline.place) || result_.found.size() <= n_before)
            return false;
        note_what_shapes_leave_open(result_.baseline.place);
        Found& newest = result_.found.back();
        if (fate_of(certainties_of().back(), newest.gain, threshold_) == Fate::stays) {
            if (newest.doubt.empty()) newest.doubt = "it is seen only beside functions";
            return true;
        }
        result_.log.push_back(
            {result_.last.model.effects.back().name, nearly_nothing, 0, 0, 0, {}});
        return false;
    }

    /// What ended the search: all of it is to be done again by the right hour.
    const std::optional<LateClock>& late_clock() const { return late_clock_; }

  private:
    bool accept_one(const Place& place) {
        Step step = search(data_, place, result_.last, barred_);
        log_step(step, result_.log);
        threshold_ = step.threshold;
        result_.candidates.clear();
        for (const Refitted& candidate : step.ranking)
            if (!candidate.objection.empty())
                result_.candidates.emplace_back(label_of(candidate.effect),
                                                candidate.gain);
        if (step.chosen < 0) {
            result_.log.push_back({"", "nothing passes", 0, step.threshold, 0, {}});
            note_what_moves(step);
            return false;
        }
        const EffectClass near = class_of(data_, result_.last, step);
        Refitted& chosen = step.ranking[static_cast<std::size_t>(step.chosen)];
        const std::string doubt = doubt_of(chosen, near, step.threshold);
        result_.found.push_back({near.names, doubt, chosen.gain, near.rivals});
        const double before = alarm_of(data_, place, result_.last, chosen.effect);
        const std::size_t newest = chosen.standing.model.effects.size() - 1;
        const std::string name = chosen.effect.name;
        result_.last = refine_shape(data_, place, std::move(chosen.standing), newest);
        if (start_again(data_, place, result_.last)) {
            result_.log.push_back({name, "calibrated anew with it", 0, 0, 0, {}});
            result_.last = refine_shape(data_, place, std::move(result_.last), newest);
        }
        if (may_set_clock_ && result_.hours_late == 0)
            late_clock_ = late_clock_in_place_of(data_, result_.last, newest);
        if (late_clock_) return false;
        const double needed = 0.5 * step.threshold;
        const bool is_split = split(data_, place, result_.last, newest, needed);
        if (doubt.empty() && !is_over(before, alarm_left(place, newest, chosen.effect)))
            result_.found.back().doubt = "the pattern that pointed to it is still there";
        if (is_split) note_split(newest);
        swap_earlier(place);
        drop(prune(data_, place, result_.last, needed), "left again: no longer needed");
        drop(prune_implausible(data_, place, result_.last),
             "left again: coefficient no longer plausible");
        bar_if_gone(name);
        return true;
    }

    /// Why an effect's name may be the nearest one only, before its alarm is looked at.
    std::string doubt_of(const Refitted& chosen, const EffectClass& near,
                         double threshold) const {
        if (!chosen.effect.is_named()) return "it says where and when, not why";
        if (!near.is_told) return "others do nearly as well";
        if (!is_overwhelming(chosen.gain, threshold))
            return "its evidence is less than three times what noise shows";
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

    /// A model that is not the building leaves a residual that many terms of the
    /// catalogue and the grammar can take a part of. An effect is told from that misfit
    /// only where it carries clearly more than the best of those that did not pass (an
    /// empirical null: Efron 2004, JASA 99).
    void leave_what_does_not_stand_out(const Place& place) {
        constexpr double least_evidence_ratio = 1.5;  ///< to the best that did not pass
        if (result_.candidates.empty()) return;
        if (threshold_ > 0)
            result_.misfit = std::max(1.0, result_.candidates[0].second / threshold_);
        drop(prune(data_, place, result_.last,
                   least_evidence_ratio * result_.candidates[0].second),
             "left: does not stand out from the model's misfit");
    }

    /// An effect whose coefficient may nearly be nothing leaves, the least certain first.
    /// Says whether one did.
    bool leave_least_certain(const Place& place) {
        note_what_shapes_leave_open(place);
        const auto certainties = certainties_of();
        std::optional<std::size_t> weakest;
        for (std::size_t k = 0; k < certainties.size(); ++k) {
            Found& found = result_.found[k];
            const Fate fate = fate_of(certainties[k], found.gain, threshold_);
            if (fate == Fate::is_doubtful && found.doubt.empty())
                found.doubt = "its coefficient may be nearly nothing";
            if (fate == Fate::leaves &&
                (!weakest || certainties[k] < certainties[*weakest]))
                weakest = k;
        }
        const auto gone =
            weakest ? take_out(data_, place, result_.last, *weakest) : std::nullopt;
        if (!gone) return false;
        drop({*gone}, nearly_nothing);
        return true;
    }

    void note_what_shapes_leave_open(const Place& place) {
        for (std::size_t k = 0; k < result_.found.size(); ++k)
            result_.found[k].of_shape =
                deviation_over_shapes(data_, place, result_.last, k, result_.misfit);
    }

    /// How many standard deviations each effect's coefficient is from 0, by all that its
    /// interval holds.
    std::vector<double> certainties_of() const {
        const Standing& last = result_.last;
        const auto sds = deviations_of(data_, last, result_.misfit);
        std::vector<double> certainties;
        for (std::size_t k = 0; k < result_.found.size(); ++k) {
            const double c = last.coefficient(k);
            const double of_noise = sds[last.built.first_effect() + k];
            certainties.push_back(std::abs(c) /
                                  deviation_of(result_.found[k], of_noise, c));
        }
        return certainties;
    }

    void note_split(std::size_t effect) {
        const auto& all = result_.last.model.effects;
        Found& plant = result_.found[effect];
        plant.rivals.clear();
        plant.equivalents = {all[effect].name};
        Found use = plant;
        use.equivalents = {all.back().name};
        result_.log.push_back({all.back().name, "split from the plant's", 0, 0, 0, {}});
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
            result_.log.push_back({label_of(now), "in place of " + was, 0, 0, 0, {}});
            found.equivalents = {now.name, was};
            found.doubt = "it stands in the place of another";
        }
    }

    /// Forgets what was said of effects that have left.
    void drop(const std::vector<Gone>& all, const char* why) {
        for (const Gone& gone : all) {
            result_.log.push_back({gone.name, why, 0, 0, 0, {}});
            result_.found.erase(result_.found.begin() +
                                static_cast<std::ptrdiff_t>(gone.index));
        }
        name_halves_as_wholes();
    }

    /// A half that stands for both again has the whole's name.
    void name_halves_as_wholes() {
        for (std::size_t k = 0; k < result_.found.size(); ++k) {
            const std::string& name = result_.last.model.effects[k].name;
            auto& said = result_.found[k].equivalents;
            if (said == std::vector{name + suffix_of_use}) said = {name};
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

/// The last model with functions, found about it as it is without any.
void lay_rest_to_functions(const LoopData& data, const Place& place, LoopResult& result) {
    result.baseline.place = place;
    result.functions = find_functions(data, result.baseline.place, result.last);
}

/// What a search sees where functions have taken the misfit: readings less what functions
/// bring to them, and the last model without functions. Candidates without a name are
/// left to functions.
struct BesideFunctions {
    LoopData data;
    LoopResult result;
};

/// Nothing where the model needs its functions to be simulated.
std::optional<BesideFunctions> beside_functions(const LoopData& data, const Place& place,
                                                const LoopResult& result) {
    BesideFunctions beside{data, result};
    beside.data.options.generic = false;
    beside.result.baseline.place = place;
    Standing& last = beside.result.last;
    last.built = build(place, last.model.effects);
    last.fit.at = {last.fit.at.x, {}, {}};
    refit(data, last, only_derivatives);
    if (last.fit.failed) return std::nullopt;
    for (std::size_t k = 0; k < data.targets.size(); ++k)
        beside.data.targets.measured[k] -=
            result.last.fit.at.predicted[k] - last.fit.at.predicted[k];
    settle(beside.data, last);
    return beside;
}

/// A model's misfit hides what is small, and functions take the misfit: beside them
/// effects with a name are searched once more. One that passes joins the model without
/// functions, which are found again. All of it stays if it foretells unseen readings
/// better than the functions that were there.
void search_beside_functions(const LoopData& data, const Place& place, LoopResult& result,
                             UnderWay& under_way) {
    const auto most = static_cast<std::size_t>(data.options.most_effects);
    while (!result.functions.empty() && result.last.model.effects.size() < most) {
        under_way.begin("effects beside functions");
        auto beside = beside_functions(data, place, result);
        if (!beside) return;
        LoopResult& tried = beside->result;
        tried.log.push_back({"", "functions join; once more beside them", 0, 0, 0, {}});
        const bool is_added =
            Search(beside->data, tried, under_way, false).add_beside_functions();
        result.log = tried.log;
        if (!is_added) return;
        settle(data, tried.last);
        if (tried.last.fit.failed) return;
        lay_rest_to_functions(data, place, tried);
        const auto score_of = [&](const LoopResult& one) {
            return deviance(data.targets, result.last.noise, one.last.left_out);
        };
        const double gained = score_of(result) - score_of(tried);
        tried.log.push_back({tried.last.model.effects.back().name,
                             gained > 0 ? "stays: both foretell more than functions did"
                                        : "left: functions foretell as much without it",
                             0,
                             0,
                             gained,
                             {}});
        if (gained <= 0) {
            result.log = tried.log;
            return;
        }
        tried.candidates = result.candidates;
        result = std::move(tried);
    }
}

/// The building as it is written, with the hours that nobody wrote down, which are
/// learned in the standard's model, and again in the structure that is then chosen.
class WithHours {
  public:
    WithHours(const LoopData& written, UnderWay& under_way)
        : written_(written),
          under_way_(under_way),
          hours_(usual_hours_of(written.building)) {
        under_way_.begin(hours_.empty() ? calibrating : "calibrating");
        if (hours_.empty()) {
            baseline_ = make_baseline(written);
            return;
        }
        plain_ = calibrate_plain(written);
        if (plain_->fit.failed) return;
        learn(*plain_);
        if (baseline_.chosen.fit.failed || baseline_.chosen.model.structure.empty())
            return;
        learn(baseline_.chosen);
    }

    const LoopData& data() const { return data_ ? *data_ : written_; }

    /// Of the plain one the hours are the usual ones.
    Baseline take_baseline() {
        if (plain_) baseline_.plain = std::move(*plain_);
        return std::move(baseline_);
    }
    std::vector<LearnedHours> take_hours() { return std::move(hours_); }

  private:
    static constexpr const char* calibrating = "calibrating, choosing the structure";

    void learn(const Standing& standing) {
        const auto before = hours_;
        under_way_.begin("learning hours");
        hours_ = learn_hours(data(), standing, std::move(hours_));
        if (data_ && have_same_hours(before, hours_)) return;
        data_.emplace(with_hours(written_.building, hours_), written_.options);
        under_way_.begin(calibrating);
        baseline_ = make_baseline(*data_);
    }

    const LoopData& written_;
    UnderWay& under_way_;
    std::optional<LoopData> data_;  ///< where hours were learned
    std::optional<Standing> plain_;
    std::vector<LearnedHours> hours_;
    Baseline baseline_;
};

/// Everything of one building; empty where it cannot be simulated as described.
study::Conclusion searched(const std::string& name, const LoopData& written,
                           UnderWay& under_way, int hours_late = 0) {
    Begin begin = begin_search(written, under_way);
    if (begin.failed()) return {};
    const Ended ended = search_from(*begin.data, std::move(begin.baseline),
                                    std::move(begin.hours), under_way, hours_late);
    if (const auto& late = ended.late_clock) {
        const study::Case set = with_clock_set(written.building, *late);
        return searched(name, LoopData(set, written.options), under_way, late->hours);
    }
    return conclude_loop(written.building.name + "/" + name, written, *begin.data,
                         ended.result);
}

class Loop : public study::Stage {
  public:
    Loop(std::string name, const std::vector<study::Case>& buildings,
         const LoopOptions& options)
        : name_(std::move(name)), buildings_(buildings), options_(options) {
        for (const study::Case& building : buildings_)
            if (!has_training(building, options_))
                throw std::invalid_argument("building " + building.name +
                                            " has no reading in its training period");
    }

    std::string name() const override { return name_; }
    int n_items() const override { return static_cast<int>(buildings_.size()); }
    long long n_simulations() const override { return usual_simulations * n_items(); }
    std::size_t answer_bytes() const override { return 6'000'000; }

    study::Activity activity() const override {
        study::Activity activity;
        under_way_.each([&](const UnderWay& each) {
            activity.text += (activity.text.empty() ? "" : "; ") + each.text();
        });
        activity.n_items = under_way_.count();
        return activity;
    }

    study::ItemAnswer run(int item) const override {
        study::ItemAnswer answer;
        const LoopData data(buildings_[static_cast<std::size_t>(item)], options_);
        const study::Running<UnderWay>::Item under_way(under_way_, data.building.name);
        const study::Conclusion conclusion = searched(name_, data, *under_way);
        if (conclusion.datasets.empty())
            answer.error = data.building.name + " cannot be simulated as described";
        else
            answer.values = study::pack(conclusion);
        return answer;
    }

    study::Conclusion conclude(
        const std::vector<study::ItemAnswer>& answers) const override {
        study::Conclusion all;
        for (const study::ItemAnswer& answer : answers) {
            if (!answer.error.empty()) continue;
            study::Conclusion one = study::unpack_conclusion(answer.values);
            std::ranges::move(one.datasets, std::back_inserter(all.datasets));
            std::ranges::move(one.summaries, std::back_inserter(all.summaries));
        }
        return all;
    }

  private:
    std::string name_;
    const std::vector<study::Case>& buildings_;  ///< the job's
    LoopOptions options_;
    mutable study::Running<UnderWay> under_way_;
};

}  // namespace

Begin begin_search(const LoopData& written, UnderWay& under_way) {
    WithHours start(written, under_way);
    Begin begin;
    begin.data = std::make_unique<const LoopData>(start.data());
    begin.baseline = start.take_baseline();
    begin.hours = start.take_hours();
    return begin;
}

Ended search_from(const LoopData& data, Baseline baseline,
                  std::vector<LearnedHours> hours, UnderWay& under_way, int hours_late,
                  bool may_set_clock) {
    Ended ended;
    LoopResult& result = ended.result;
    result.hours_late = hours_late;
    result.baseline = std::move(baseline);
    result.hours = std::move(hours);
    know_loads(result.baseline.place, result.baseline.chosen);
    const Place& place = result.baseline.place;
    under_way.begin("power of the readings");
    result.power = power_of(data, place, result.baseline.chosen);
    result.before = localise(data, place, result.baseline.chosen);
    result.last = result.baseline.chosen;
    Search search(data, result, under_way, may_set_clock);
    search.run();
    ended.late_clock = search.late_clock();
    if (ended.late_clock) return ended;
    if (result.last.model.effects.empty()) result.last = result.baseline.chosen;
    under_way.begin("functions");
    if (data.options.functions) {
        const Place without = place;
        lay_rest_to_functions(data, without, result);
        search_beside_functions(data, without, result, under_way);
    }
    under_way.begin("intervals");
    result.after = localise(data, place, result.last);
    result.unexplained = unexplained_of(data, result.last);
    return ended;
}

bool has_training(const study::Case& building, const LoopOptions& options) {
    return std::ranges::any_of(
        training_readings(building, study::period_of(building, options.period)),
        [](const kernel::Readings& meter) { return study::has_reading(meter.values); });
}

std::unique_ptr<study::Stage> make_loop(std::string name,
                                        const std::vector<study::Case>& buildings,
                                        const LoopOptions& options) {
    return std::make_unique<Loop>(std::move(name), buildings, options);
}

}  // namespace bemcal::loop
