/// What the derivative of a year costs, beside the value: an hourly gas meter of the
/// office of bench_office.hpp, 10 and 30 parameters; with an air system and a plant that
/// cycles its electricity.
///
/// The value is Response::predict, and Batch::evaluate with the meter's errors; the
/// derivative is predict and pull_back, all points with sensitivities of their own.
/// Instructions are the difference of two runs of this program under callgrind.
#include "bench_office.hpp"
#include "kernel/response.hpp"

#include <cstring>

namespace bemcal::physics {

namespace {

/// The first ten: what a calibration would vary.
constexpr std::array paths = {"construction.wall.u_value",
                              "glazing.double.u_value",
                              "glazing.double.solar_transmittance",
                              "zone.office.flow.ventilation.air_change",
                              "zone.office.flow.infiltration.air_change",
                              "zone.office.heat_capacity",
                              "zone.office.heating_capacity",
                              "zone.office.heating_set_point",
                              "zone.office.load.*.density",
                              "plant.heating_efficiency",
                              "construction.wall.solar_absorptance",
                              "construction.wall.emissivity",
                              "construction.wall.external_resistance",
                              "glazing.double.incidence_factor",
                              "glazing.double.frame_fraction",
                              "glazing.double.emissivity",
                              "glazing.double.external_resistance",
                              "zone.office.floor_area",
                              "zone.office.volume",
                              "zone.office.mass_area_ratio",
                              "zone.office.surface_area_ratio",
                              "zone.office.surface_film",
                              "zone.office.mass_film",
                              "zone.office.sky_temperature_difference",
                              "zone.office.cooling_set_point",
                              "zone.office.cooling_capacity",
                              "zone.office.surface.wall.area",
                              "zone.office.window.window.area",
                              "zone.office.window.window.shading_factor",
                              "zone.office.load.*.heat_fraction"};

std::vector<Parameter> first_parameters(const Building& building, std::size_t n) {
    std::vector<Parameter> parameters;
    for (std::size_t k = 0; k < n; ++k)
        parameters.push_back(
            {paths[k], "-", 0.95, 1.05, Effect::factor, resolve(building, paths[k]), 1});
    return parameters;
}

/// Factors from 0.95 to 1.05, spread by the golden section.
Matrix points_near(std::size_t n, std::size_t d) {
    Matrix points(n, d);
    for (std::size_t k = 0; k < n * d; ++k) {
        const double position = 0.618033988749895 * static_cast<double>(k);
        points.values[k] = 0.95 + 0.1 * (position - std::floor(position));
    }
    return points;
}

/// The office as the standard has it, with a heat capacity of the air and a second mass,
/// or with an air system.
enum class Hour { standard, refined, supplied };

/// Variable flow with an economiser in moist weather, and a plant that cycles.
void add_air_system(Building& building) {
    AirSystem system;
    system.name = "unit";
    system.available = {1, 0, 3};
    system.economiser = {1, 0, -1};
    system.people_moisture = {3, 0, 0};
    system.limited_by = EconomiserLimit::dry_bulb;
    building.air_systems.push_back(system);
    building.zones[0].air_system = 0;
    building.zones[0].system_flow = 0;
    building.plant.cooling_least_load = 20;
    building.plant.cooling_cycling_loss = 0.15;
}

Building building_with(Hour hour) {
    Building building = bench_building();
    if (hour == Hour::supplied) add_air_system(building);
    if (hour != Hour::refined) return building;
    Structure& structure = building.zones[0].structure;
    structure.air_capacity = 10000;
    structure.second_mass_conductance = 2;
    structure.second_mass_capacity = 200000;
    return building;
}

Drive drive_with(Hour hour) {
    Drive drive = bench_drive();
    if (hour == Hour::supplied)
        for (const double theta : drive.theta_e)
            drive.w_e.push_back(0.004 + 0.0002 * std::max(theta, 0.0));
    return drive;
}

struct Bench {
    Quantity quantity;
    Building building;
    Drive drive;
    std::vector<Parameter> parameters;
    kernel::Batch batch;
    kernel::Response response;
    kernel::Response::RunPointer run;
    kernel::Request request;
    Matrix gradient;

    Bench(kernel::InstructionSet set, std::size_t n_parameters,
          Hour hour = Hour::standard)
        : quantity(hour == Hour::supplied ? Quantity::electricity : Quantity::gas),
          building(building_with(hour)),
          drive(drive_with(hour)),
          parameters(first_parameters(building, n_parameters)),
          batch(building, parameters, drive, set),
          response(batch, {{quantity, Interval::hourly}}),
          run(response.make_run()),
          request{{}, {}, {readings()}},
          gradient(static_cast<std::size_t>(batch.lanes()), n_parameters) {
        double* sensitivities = response.sensitivities(*run, 0);
        const std::size_t n = response.n_readings(0) * gradient.rows;
        for (std::size_t k = 0; k < n; ++k)
            sensitivities[k] = 1 + 0.5 * std::sin(static_cast<double>(k));
    }

    kernel::Readings readings() const {
        return {quantity, Interval::hourly,
                predict(building, drive, simulate(building, drive), quantity)};
    }
    Matrix points(std::size_t n) const { return points_near(n, parameters.size()); }

    void evaluate(const Matrix& points) { batch.evaluate(points, request); }
    void predict_all(const Matrix& points, bool pull) {
        for (std::size_t k = 0; k < points.rows; k += gradient.rows) {
            response.predict(points, k, gradient.rows, *run);
            if (pull) response.pull_back(*run, gradient);
        }
    }
    void work(const std::string& name, const Matrix& points) {
        if (name == "evaluate")
            evaluate(points);
        else
            predict_all(points, name == "derivative");
    }
};

/// Per simulated hour and point.
double instructions_per_hour(const std::string& self, const char* work,
                             std::size_t n_parameters) {
    const int few = 16, many = 48;
    const auto count = [&](int n) {
        return instructions(self, fmt::format("{} {} {}", work, n_parameters, n));
    };
    const long long a = count(few), b = count(many);
    return a < 0 || b < 0
               ? std::nan("")
               : static_cast<double>(b - a) / (static_cast<double>(many - few) * hours);
}

void print_instructions(const std::string& self) {
    const double evaluate = instructions_per_hour(self, "evaluate", 10),
                 predict = instructions_per_hour(self, "predict", 10),
                 ten = instructions_per_hour(self, "derivative", 10),
                 thirty = instructions_per_hour(self, "derivative", 30);
    if (std::isnan(evaluate)) {
        fmt::print("instructions: valgrind is not there or failed\n");
        return;
    }
    print("instructions_per_hour_errors", evaluate, "1/h");
    print("instructions_per_hour_predict", predict, "1/h");
    print("instructions_per_hour_derivative", ten, "1/h", evaluate);
    print("instructions_derivative_over_errors", ten / evaluate, "-", 4);
    print("instructions_derivative_over_predict", ten / predict, "-", 4);
    print("instructions_30_over_10_parameters", thirty / ten, "-", 1.15);
}

void print_times(kernel::InstructionSet set) {
    constexpr std::size_t n = 64;
    Bench few(set, 10), many(set, 30);
    const Matrix points = few.points(n), wide = many.points(n);
    const auto [evaluate, predict, ten, thirty] = medians<4>(
        {[&] { few.work("evaluate", points); }, [&] { few.work("predict", points); },
         [&] { few.work("derivative", points); },
         [&] { many.work("derivative", wide); }});
    const std::string suffix = fmt::format("_{}", kernel::name_of(set));
    print("year_errors" + suffix, evaluate / n, "us");
    print("year_predict" + suffix, predict / n, "us");
    print("year_derivative" + suffix, ten / n, "us");
    print("derivative_over_errors" + suffix, ten / evaluate, "-", 4);
    print("derivative_over_predict" + suffix, ten / predict, "-", 4);
    print("derivative_30_over_10_parameters" + suffix, thirty / ten, "-", 1.15);
}

void print_more(kernel::InstructionSet set, Hour hour, const char* name, double most) {
    constexpr std::size_t n = 32;
    Bench bench(set, 10, hour);
    const Matrix points = bench.points(n);
    const auto [predict, derivative] =
        medians<2>({[&] { bench.work("predict", points); },
                    [&] { bench.work("derivative", points); }});
    const std::string suffix = fmt::format("_{}", kernel::name_of(set));
    print(name + ("_year_derivative" + suffix), derivative / n, "us");
    print(name + ("_derivative_over_predict" + suffix), derivative / predict, "-", most);
}

}  // namespace

/// What callgrind counts: bench_adjoint WORK PARAMETERS POINTS.
int run_counted(char** arguments) {
    Bench bench(kernel::InstructionSet::v3,
                static_cast<std::size_t>(std::atoi(arguments[1])));
    bench.work(arguments[0],
               bench.points(static_cast<std::size_t>(std::atoi(arguments[2]))));
    return 0;
}

int run_all(const std::string& self) {
    print_instructions(self);
    for (kernel::InstructionSet set :
         {kernel::InstructionSet::scalar, kernel::InstructionSet::v3,
          kernel::InstructionSet::v4})
        if (kernel::is_supported(set)) {
            print_times(set);
            print_more(set, Hour::refined, "refined", 4);
            print_more(set, Hour::supplied, "air_system", 4.5);
        }
    return 0;
}

}  // namespace bemcal::physics

int main(int argc, char** argv) {
    return argc == 4 ? bemcal::physics::run_counted(argv + 1)
                     : bemcal::physics::run_all(argv[0]);
}
