/// A stage whose answers are known, for tests of what surrounds stages: item k answers
/// with 1 + k % 3 numbers that follow from k; some of its points, or the whole item, may
/// fail.
#pragma once

#include "study/stage.hpp"

#include <chrono>
#include <cmath>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>

namespace bemcal::test {

struct FakeStageOptions {
    int n_items = 100;
    std::chrono::microseconds sleep{0};  ///< in each item
    int fails_at = -1;                   ///< this item throws
};

class FakeStage : public study::Stage {
  public:
    using Options = FakeStageOptions;
    explicit FakeStage(std::string name, Options options = {})
        : name_(std::move(name)), options_(options) {}

    std::string name() const override { return name_; }
    int n_items() const override { return options_.n_items; }
    long long n_simulations() const override { return 10LL * options_.n_items; }
    std::size_t answer_bytes() const override { return 64; }

    study::ItemAnswer run(int item) const override {
        std::this_thread::sleep_for(options_.sleep);
        if (item == options_.fails_at) throw std::runtime_error("item fails on purpose");
        study::ItemAnswer answer;
        for (int k = 0; k <= item % 3; ++k)
            answer.values.push_back(std::sin(item + 0.1 * k));
        if (item % 7 == 0) answer.failures = {{10LL * item, "the zone left the method"}};
        return answer;
    }

    study::Conclusion conclude(
        const std::vector<study::ItemAnswer>& answers) const override {
        std::vector<double> scores, failed;
        std::vector<std::string> reasons;
        for (const auto& answer : answers) {
            double sum = 0;
            for (const double value : answer.values) sum = sum * 1.1 + value;
            scores.push_back(answer.error.empty() ? sum : std::nan(""));
            for (const auto& failure : answer.failures) {
                failed.push_back(static_cast<double>(failure.point));
                reasons.push_back(failure.reason);
            }
        }
        const std::size_t n_scores = scores.size(), n_failed = failed.size();
        return {
            {{name_ + "/score", {"point"}, {n_scores}, std::move(scores), {}},
             {name_ + "/failed_point", {"failure"}, {n_failed}, std::move(failed), {}},
             {name_ + "/failed_reason",
              {"failure"},
              {n_failed},
              {},
              std::move(reasons)}}};
    }

  private:
    std::string name_;
    Options options_;
};

}  // namespace bemcal::test
