/// What the fast kernel costs, beside the same code one point at a time.
///
/// The office of bench_office.hpp over a year of hours, annual heating and cooling.
/// Instructions are the difference of two runs of this program, so that start-up and plan
/// cancel; everything else counts: coefficients, time loop, answers.
#include "bench_office.hpp"
#include "kernel/batch.hpp"
#include "physics/parameters.hpp"

namespace bemcal::physics {

namespace {

std::vector<Parameter> bench_parameters(const Building& building) {
    std::vector<Parameter> parameters;
    for (const char* path :
         {"construction.wall.u_value", "glazing.double.u_value",
          "glazing.double.solar_transmittance", "zone.office.flow.ventilation.air_change",
          "zone.office.flow.infiltration.air_change", "zone.office.heat_capacity",
          "zone.office.heating_capacity", "zone.office.load.*.density"})
        parameters.push_back(
            {path, "-", 0.8, 1.2, Effect::factor, resolve(building, path), 1});
    return parameters;
}

/// Spread over the ranges by the golden section.
Matrix bench_points(std::size_t n, std::size_t d) {
    Matrix points(n, d);
    for (std::size_t k = 0; k < n * d; ++k) {
        const double position = 0.618033988749895 * static_cast<double>(k);
        points.values[k] = 0.8 + 0.4 * (position - std::floor(position));
    }
    return points;
}

struct Bench {
    Building building = bench_building();
    Drive drive = bench_drive();
    std::vector<Parameter> parameters = bench_parameters(building);
    kernel::Request annual{{Quantity::heating, Quantity::cooling}, {}, {}};
    kernel::Request hourly_meter{annual.annual, {}, {readings()}};

    Matrix points(std::size_t n) const { return bench_points(n, parameters.size()); }
    kernel::Batch batch(kernel::InstructionSet set) const {
        return {building, parameters, drive, set};
    }
    kernel::Readings readings() const {
        return {Quantity::gas, Interval::hourly,
                predict(building, drive, simulate(building, drive), Quantity::gas)};
    }
};

/// Per simulated hour and point; each run evaluates whole groups.
double instructions_per_hour(const std::string& self, kernel::InstructionSet set,
                             const char* request) {
    const int few = 32, many = 96;
    const auto count = [&](int n) {
        return instructions(self,
                            fmt::format("{} {} {}", kernel::name_of(set), request, n));
    };
    const long long a = count(few), b = count(many);
    return a < 0 || b < 0
               ? std::nan("")
               : static_cast<double>(b - a) / (static_cast<double>(many - few) * hours);
}

void print_instructions(const std::string& self) {
    const struct {
        const char* name;
        kernel::InstructionSet set;
        const char* request;
        double reach;
    } lines[] = {
        {"instructions_per_hour", kernel::InstructionSet::v3, "annual", 7.5},
        {"instructions_per_hour_scalar", kernel::InstructionSet::scalar, "annual", 40},
        {"instructions_per_hour_sse_fused", kernel::InstructionSet::v3, "hourly_meter",
         7.5}};
    for (const auto& line : lines) {
        const double count = instructions_per_hour(self, line.set, line.request);
        if (std::isnan(count))
            fmt::print("{}: valgrind is not there or failed\n", line.name);
        else
            print(line.name, count, "1/h", line.reach);
    }
}

constexpr std::size_t n = 1024;  ///< points of an item

void print_times(const Bench& bench) {
    const Matrix points = bench.points(n);
    const kernel::Batch scalar = bench.batch(kernel::InstructionSet::scalar),
                        v3 = bench.batch(kernel::InstructionSet::v3);
    const auto group = v3.make_group();
    const auto lanes = static_cast<std::size_t>(v3.lanes());
    const auto [one, annual, compared, prepared] =
        medians<4>({[&] { scalar.evaluate(points, bench.annual); },
                    [&] { v3.evaluate(points, bench.annual); },
                    [&] { v3.evaluate(points, bench.hourly_meter); },
                    [&] {
                        for (std::size_t k = 0; k < n; k += lanes)
                            v3.prepare(points, k, lanes, *group);
                    }});
    print("speedup_v3_over_scalar", one / annual, "-", 4.5);
    print("simulations_per_second_per_core", n / annual * 1e6, "1/s");
    print("sse_fused_ratio", compared / annual, "-", 1.1);
    print("year_scalar", one / n, "us");
    print("year_v3", annual / n, "us");
    print("preparation_v3", prepared / n, "us", annual / n);
}

void print_v4(const Bench& bench) {
    if (!kernel::is_supported(kernel::InstructionSet::v4)) {
        fmt::print("v4: this processor has no AVX-512, so its kernel cannot run here\n");
        return;
    }
    const Matrix points = bench.points(n);
    const kernel::Batch scalar = bench.batch(kernel::InstructionSet::scalar),
                        v4 = bench.batch(kernel::InstructionSet::v4);
    const auto [one, annual] = medians<2>({[&] { scalar.evaluate(points, bench.annual); },
                                           [&] { v4.evaluate(points, bench.annual); }});
    print("speedup_v4_over_scalar", one / annual, "-", 9);
}

void print_plain(const Bench& bench) {
    const auto [plain] = medians<1>({[&] { simulate(bench.building, bench.drive); }});
    print("year_plain_version", plain, "us");
}

kernel::InstructionSet set_named(const std::string& name) {
    if (name == "v4") return kernel::InstructionSet::v4;
    return name == "scalar" ? kernel::InstructionSet::scalar : kernel::InstructionSet::v3;
}

}  // namespace

/// What callgrind counts: bench_kernel SET REQUEST POINTS.
int run_counted(char** arguments) {
    const Bench bench;
    const bool metered = std::string(arguments[1]) == "hourly_meter";
    bench.batch(set_named(arguments[0]))
        .evaluate(bench.points(static_cast<std::size_t>(std::atoi(arguments[2]))),
                  metered ? bench.hourly_meter : bench.annual);
    return 0;
}

int run_all(const std::string& self) {
    const Bench bench;
    print_instructions(self);
    print_times(bench);
    print_v4(bench);
    print_plain(bench);
    return 0;
}

}  // namespace bemcal::physics

int main(int argc, char** argv) {
    return argc == 4 ? bemcal::physics::run_counted(argv + 1)
                     : bemcal::physics::run_all(argv[0]);
}
