/// Makes #SBATCH lines of a plan's cost: cores that end it in half an hour, ranks of up
/// to eight cores, 1.5 times the memory, twice the time and ten minutes.
/// Follows from `plan_cost`; the margins are rules of thumb.
/// Leaves out partitions and accounts. Time ends at a day: an unfinished job is requeued.
#include "plan/slurm_lines.hpp"

#include "physics/calendar.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace bemcal::plan {

namespace {

constexpr int most_cores_of_rank = 8, usual_cores = 16;
constexpr double half_an_hour = 1800, ten_minutes = 600, day = physics::day_s;
constexpr double megabyte = 1e6, program_bytes = 1e8;

struct Shape {
    int n_nodes = 1, ranks_per_node = 1, cores_per_rank = 1;
    int cores() const { return n_nodes * ranks_per_node * cores_per_rank; }
};

int wanted_cores(const PlanCost& cost, const SlurmRequest& request) {
    if (request.cores_per_node > 0) return request.cores_per_node;
    int cores = 1;
    const int nodes = std::max(1, request.n_nodes);
    while (cores < usual_cores && cost.core_seconds / (cores * nodes) > half_an_hour)
        cores *= 2;
    return cores;
}

Shape shape_of(const PlanCost& cost, const SlurmRequest& request) {
    Shape shape;
    shape.n_nodes = std::max(1, request.n_nodes);
    const double useful = std::ceil(cost.items / shape.n_nodes);
    const int cores = static_cast<int>(
        std::clamp(useful, 1.0, static_cast<double>(wanted_cores(cost, request))));
    shape.cores_per_rank = std::min(cores, most_cores_of_rank);
    shape.ranks_per_node = cores / shape.cores_per_rank;
    return shape;
}

/// Of the node with rank 0, which holds all answers.
long long megabytes_of(const PlanCost& cost, const Shape& shape) {
    const double bytes =
        2 * cost.answer_bytes +
        shape.ranks_per_node * (3 * cost.data_bytes + program_bytes + cost.working_bytes);
    return std::max(
        500LL, static_cast<long long>(std::ceil(1.5 * bytes / megabyte / 100)) * 100);
}

std::string time_of(const PlanCost& cost, const Shape& shape) {
    const double seconds =
        std::min(day, 2 * cost.core_seconds / shape.cores() + ten_minutes);
    const auto minutes = 10 * static_cast<long long>(std::ceil(seconds / ten_minutes));
    return fmt::format("{:02}:{:02}:00", minutes / 60, minutes % 60);
}

}  // namespace

std::string slurm_lines(const PlanCost& cost, const SlurmRequest& request) {
    const Shape shape = shape_of(cost, request);
    return fmt::format(
        "# {:.0f} items, {:.0f} simulations, about {:.2g} hours of one core\n"
        "#SBATCH --nodes={} --ntasks-per-node={} --cpus-per-task={}\n"
        "#SBATCH --mem={}M --time={}\n"
        "#SBATCH --signal=B:USR1@120 --requeue --open-mode=append\n",
        cost.items, cost.simulations, cost.core_seconds / 3600, shape.n_nodes,
        shape.ranks_per_node, shape.cores_per_rank, megabytes_of(cost, shape),
        time_of(cost, shape));
}

}  // namespace bemcal::plan
