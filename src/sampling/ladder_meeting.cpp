/// What happens when a ladder's walkers meet: neighbours swap points, even and odd pairs
/// in turn, and temperatures move until all pairs swap equally often.
/// Source: Syed et al. 2022 (JRSS B 84(2)). The number of temperatures is the caller's
/// and is not learnt.
#include "sampling/adaptation.hpp"
#include "sampling/ladder.hpp"
#include "sampling/temperatures.hpp"

#include <algorithm>
#include <cmath>

namespace bemcal::sampling {

/// The last to arrive swaps, lets the others go, and does not wait.
bool Ladder::wait_for_others(std::coroutine_handle<> walker) {
    if (arrived_.size() + 1 < walkers_.size()) {
        arrived_.push_back(walker);
        return true;
    }
    swap_neighbours();
    if (std::ranges::count(tunings_, n_meetings_) > 0) tune_temperatures();
    leaving_.swap(arrived_);
    arrived_.clear();
    for (const std::coroutine_handle<> other : leaving_) other.resume();
    return false;
}

void Ladder::swap_neighbours() {
    const auto parity = static_cast<std::size_t>(std::fmod(n_meetings_, 2));
    for (std::size_t pair = 0; pair < swapped_.size(); ++pair) {
        const double probability = swap_probability(pair);
        refused_[pair] += 1 - probability;
        if (pair % 2 != parity) continue;
        const bool swaps = random_.uniform() < probability;
        if (swaps) std::swap(walkers_[pair].current, walkers_[pair + 1].current);
        swapped_[pair] = swaps ? 1 : 0;
    }
    ++n_meetings_;
}

double Ladder::swap_probability(std::size_t pair) const {
    const Walker& cold = walkers_[pair];
    const Walker& hot = walkers_[pair + 1];
    const double gain = (cold.inverse_temperature - hot.inverse_temperature) *
                        (hot.current.likelihood - cold.current.likelihood);
    return gain >= 0 ? 1 : std::exp(gain);
}

/// When the walkers have a new metric, but for the last: that is learnt at the
/// temperatures that stay.
void Ladder::plan_tunings() {
    for (const int end : windows_of(setting_.options.n_warm_up).ends)
        tunings_.push_back(end + 1);
    if (!tunings_.empty()) tunings_.pop_back();
}

void Ladder::tune_temperatures() {
    std::vector<double> inverse_temperatures;
    inverse_temperatures.reserve(walkers_.size());
    for (const Walker& walker : walkers_)
        inverse_temperatures.push_back(walker.inverse_temperature);
    inverse_temperatures = equalised(inverse_temperatures, refused_);
    for (std::size_t i = 0; i < walkers_.size(); ++i)
        walkers_[i].inverse_temperature = inverse_temperatures[i];
    std::ranges::fill(refused_, 0.0);
}

}  // namespace bemcal::sampling
