/// Answers points group by group: prepared, warmed up, run and reduced. What went wrong
/// becomes the point's reason; where a result is not finite, the plain version is run to
/// say why.
/// Follows from Batch's parts. What is reduced, and how, is left to reduction; buildings
/// that the kernel cannot run are answered by plain_answer.
#include "base/error.hpp"
#include "kernel/batch.hpp"
#include "kernel/plain_answer.hpp"
#include "kernel/reduction.hpp"

#include <cmath>

namespace bemcal::kernel {

namespace {

constexpr const char* not_finite = "a result is not finite";

bool is_finite(const ErrorSums& sums) {
    return std::isfinite(sums.error + sums.square + sums.product + sums.relative);
}

bool is_finite(const PointAnswer& answer) {
    double sum = 0;
    for (double value : answer.annual) sum += value;
    for (double value : answer.monthly) sum += value;
    return std::isfinite(sum) &&
           std::all_of(answer.errors.begin(), answer.errors.end(),
                       [](const ErrorSums& errors) { return is_finite(errors); });
}

PointAnswer failed(const std::string& failure) {
    PointAnswer answer;
    answer.failure = failure;
    return answer;
}

/// A lane of a group that has run.
PointAnswer lane_answer(const Reduction& reduction, int lane, BatchGroup& group) {
    PointAnswer answer = reduction.answer(lane, group);
    if (group.is_finite(lane) && is_finite(answer)) return answer;
    return failed(why_not_finite(group.buildings[static_cast<std::size_t>(lane)],
                                 group.plan.drive));
}

PointAnswer plain_or_failed(const physics::Building& building,
                            const physics::Drive& drive, const Request& request) {
    try {
        PointAnswer answer = plain_answer(building, drive, request);
        return is_finite(answer) ? answer : failed(not_finite);
    } catch (const CannotSimulate& error) {
        return failed(error.what());
    }
}

std::vector<PointAnswer> evaluate_plain(const BatchPlan& batch, const Matrix& points,
                                        const Request& request) {
    std::vector<PointAnswer> answers;
    physics::Building building = batch.nominal;
    for (std::size_t point = 0; point < points.rows; ++point) {
        physics::apply(batch.nominal, batch.parameters, points.row(point), building);
        answers.push_back(plain_or_failed(building, batch.drive, request));
    }
    return answers;
}

}  // namespace

std::string why_not_finite(const physics::Building& building,
                           const physics::Drive& drive) {
    try {
        const physics::Trajectory trajectory = physics::simulate(building, drive);
        for (std::size_t q = 0; q < n_quantities; ++q)
            physics::predict(building, drive, trajectory,
                             static_cast<physics::Quantity>(q));
        return not_finite;
    } catch (const CannotSimulate& error) {
        return error.what();
    }
}

std::vector<PointAnswer> Batch::evaluate(const Matrix& points,
                                         const Request& request) const {
    if (plan_->plain) return evaluate_plain(*plan_, points, request);
    const RequestPlan request_plan(request, *plan_);
    Reduction reduction(request_plan, *plan_);
    const GroupPointer group = make_group();
    std::vector<PointAnswer> answers;
    answers.reserve(points.rows);
    const auto n_lanes = static_cast<std::size_t>(lanes());
    for (std::size_t first = 0; first < points.rows; first += n_lanes) {
        const std::size_t count = std::min(n_lanes, points.rows - first);
        const std::vector<std::string> failures = prepare(points, first, count, *group);
        warm_up(*group);
        reduction.run(*group);
        for (std::size_t k = 0; k < count; ++k)
            answers.push_back(failures[k].empty()
                                  ? lane_answer(reduction, static_cast<int>(k), *group)
                                  : failed(failures[k]));
    }
    return answers;
}

}  // namespace bemcal::kernel
