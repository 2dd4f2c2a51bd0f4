/// The stage that searches each building for effects that its description lacks: hours
/// that nobody wrote down, structure, effects, functions for what is left.
/// Each of these is left to its own file. Periods other than training are only reported.
#include "loop/loop.hpp"

#include "loop/beside_functions.hpp"
#include "loop/effect_search.hpp"
#include "loop/loads.hpp"
#include "loop/of_the_place.hpp"
#include "loop/results.hpp"
#include "loop/search_building.hpp"
#include "study/packed_conclusion.hpp"

#include <algorithm>
#include <iterator>
#include <stdexcept>

namespace bemcal::loop {
namespace {

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
    know_loads(result.baseline.place, result.baseline.chosen, {});
    const Place& place = result.baseline.place;
    under_way.begin("power of the readings");
    result.power = power_of(data, place, result.baseline.chosen);
    if (data.options.compares_place)
        result.of_the_place =
            effects_of_the_place(data, place, result.baseline.chosen, result.power);
    result.before = localise(data, place, result.baseline.chosen);
    result.last = result.baseline.chosen;
    ended.late_clock = search_effects(data, result, under_way, may_set_clock);
    if (ended.late_clock) return ended;
    if (result.last.model.effects.empty()) result.last = result.baseline.chosen;
    if (data.options.functions) search_functions(data, result, under_way);
    settle_loads(data, result.functions, result.baseline.place, result.last);
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
