/// Makes the method: NSGA-II, or a swarm, a pattern search, or one after the other.
/// Plain translation of options; the methods are those of optimise/.
#include "calibration/method.hpp"

#include "optimise/methods.hpp"
#include "optimise/nsga2.hpp"

namespace bemcal::calibration {

optimise::Method method_of(const OptimisationOptions& options, std::uint32_t stream) {
    if (options.method == OptimisationMethod::nsga2) {
        optimise::Nsga2Options nsga2;
        nsga2.n_population = options.n_population;
        nsga2.n_generations = options.n_generations;
        nsga2.seed = options.seed;
        nsga2.stream = stream;
        return make_nsga2(nsga2);
    }
    optimise::MethodOptions method;
    method.kind = static_cast<optimise::MethodKind>(options.method);
    method.swarm.n_particles = options.n_particles;
    method.with_kicks = options.restart;
    method.seed = options.seed;
    method.stream = stream;
    return make_method(method);
}

}  // namespace bemcal::calibration
