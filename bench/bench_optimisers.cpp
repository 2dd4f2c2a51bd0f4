/// How often the optimisers reach a known minimum, within 1e-4 and 50,000 evaluations, of
/// 20 seeds: the hybrid with kicks, without (as GenOpt has it), and the plain swarm
/// with the whole budget; each on the seeds 1 to 20, which were looked at while the
/// methods were made, and on others (`fresh`); and the hypervolume of NSGA-II on ZDT1,
/// 100 x 250, reference point (1.1, 1.1). References: what is asked. Lines: name value
/// unit reference ratio.
#include "optimise/facades.hpp"
#include "optimise/functions.hpp"
#include "optimise/methods.hpp"
#include "optimise/nsga2.hpp"

#include <fmt/format.h>

namespace bemcal {
namespace {

using namespace optimise;

constexpr int n_seeds = 20;
constexpr int first_fresh = 7001;
constexpr std::size_t budget = 50000;

Method hybrid(std::uint64_t seed) {
    MethodOptions options;
    options.seed = seed;
    return make_method(options);
}

Method hybrid_once(std::uint64_t seed) {
    MethodOptions options;
    options.seed = seed;
    options.with_kicks = false;
    return make_method(options);
}

/// Until the budget ends it: no mesh, no patience.
Method plain_swarm(std::uint64_t seed) {
    MethodOptions options;
    options.kind = MethodKind::swarm;
    options.swarm.mesh = 0;
    options.swarm.patience = options.swarm.most_generations =
        static_cast<int>(budget / 32);
    options.seed = seed;
    return make_method(options);
}

void print(const std::string& name, double value, const char* unit, double reference) {
    if (std::isnan(reference))
        fmt::print("{} {:.4g} {} - -\n", name, value, unit);
    else
        fmt::print("{} {:.4g} {} {:.4g} {:.4g}\n", name, value, unit, reference,
                   value / reference);
}

struct Asked {
    double successes, median_error;  ///< NaN = not asked
};

void run(const std::string& name, const test::MakeProblem& make_problem,
         const Asked& asked) {
    constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
    const auto some = [&](const std::string& method, const test::MakeMethod& make_method,
                          const Asked& wanted, int first_seed) {
        const test::Trials all =
            test::trials(make_problem, make_method, n_seeds, budget, first_seed);
        const std::string start = fmt::format("optimisers.{}.{}", name, method);
        print(start + ".successes", all.n_successes, "of_20", wanted.successes);
        print(start + ".median_error", test::median(all.errors), "-",
              wanted.median_error);
        print(start + ".median_evaluations", test::median(all.evaluations), "1", nothing);
    };
    const auto one = [&](const std::string& method, const test::MakeMethod& make_method,
                         const Asked& wanted) {
        some(method, make_method, wanted, 1);
        some(method + ".fresh", make_method, wanted, first_fresh);
    };
    one("hybrid", hybrid, asked);
    one("hybrid_without_kicks", hybrid_once, {nothing, nothing});
    one("plain_swarm", plain_swarm, {nothing, nothing});
}

void run_nsga2() {
    for (const std::uint64_t seed : {1U, 2U, 3U, 4U, 5U}) {
        Nsga2Options options;
        options.seed = seed;
        const Matrix front = test::run_zdt1(make_nsga2(options));
        print(fmt::format("optimisers.zdt1.nsga2.hypervolume_seed_{}", seed),
              test::hypervolume(front, 1.1, 1.1), "-", test::zdt1_hypervolume);
    }
}

}  // namespace

void run_all() {
    constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
    const auto of = [](auto make, std::size_t d) {
        return [make, d](std::uint64_t seed) { return make(d, seed); };
    };
    run("rosenbrock_10", of(test::rosenbrock, 10), {16, nothing});
    run("rastrigin_5", of(test::rastrigin, 5), {20, nothing});
    run("facade", test::facade, {20, nothing});
    run("facades", test::facades, {20, nothing});
    run("griewank_5", of(test::griewank, 5), {nothing, 0.03});
    run_nsga2();
}

}  // namespace bemcal

int main() {
    bemcal::run_all();
}
