/// What a model may lack, as data: an effect is a hook, a driver, a shape and a gate.
///
/// The hook says where it enters the building (an input, physics::Change), the driver
/// what it follows, the shape how, the gate when. What it brings at a step is
/// coefficient x shape(driver) x gate. Nothing here is code of its own: the catalogue
/// (catalogue.hpp) is a table of named effects, the grammar (candidates.cpp) lists the
/// others, and place (placement.hpp) turns any of them into changes of a building and one
/// parameter, so that plain and fast simulation and the adjoint know of inputs only. What
/// is known of a hook stands in its row (hooks.cpp), of a driver in its own
/// (drivers.cpp).
#pragma once

#include "physics/quantities.hpp"
#include "physics/week_hours.hpp"

#include <optional>
#include <string>
#include <vector>

namespace bemcal::effects {

/// Where an effect enters, and the unit of its coefficient per unit of what drives it.
enum class Hook {
    outdoor_air,      ///< at supply, opaque elements and windows alike [K]
    supply_air,       ///< [K]
    opaque_boundary,  ///< sol-air temperature [K]
    window_boundary,  ///< [K]
    infiltration,     ///< air from outdoors at all hours, added [1/h]
    leakage,          ///< the same, as a share of what is declared [-]
    ventilation,      ///< fans' air flows, as a share [-]
    venting,          ///< openings that follow the room (physics::Venting) and open above
                      ///< Shape::at [degC]; with Driver::one [1/h]
    opaque_conductance,  ///< of the opaque elements, as a share [-]
    window_conductance,  ///< as a share [-]
    neighbour,           ///< conductance to another temperature, per floor [W/(m2 K)]
    ground,              ///< temperatures behind elements that follow a schedule, towards
                         ///< the driver's, as a share [-]
    second_mass,         ///< conductance to a second mass, per floor [W/(m2 K)]
    aperture,            ///< solar gains through windows of a facade, as a share [-]
    heat_recovery,       ///< of ventilation, added [-]
    economiser,          ///< largest share of outdoor air of air systems, added [-]
    supply_temperature,  ///< of air systems [K]
    gains,               ///< heat nobody meters, added [W/m2]
    loads,               ///< people, lights and equipment, as a share [-]
    lights,              ///< loads that are named so, as a share [-]
    equipment,           ///< likewise [-]
    lights_and_equipment,  ///< on the electricity meter and into the room, added [W/m2]
    heating_set_point,     ///< [K]
    cooling_set_point,     ///< [K]
    room_spread,           ///< from the coldest to the warmest room [K]
    heating_available,     ///< as a share [-]
    cooling_available,     ///< as a share [-]
    operation,   ///< all scheduled inputs at once, towards another day's schedule [-]
    occupation,  ///< scheduled loads only, towards another day's schedule [-]
    plant_operation,     ///< scheduled set-points and flows only, likewise [-]
    heating_efficiency,  ///< as a share [-]
    cooling_cop,         ///< as a share [-]
    meter_addition,      ///< on a meter, without heat, per floor [W/m2]
    meter_factor         ///< what a meter shows, as a share [-]
};

/// What an effect follows; series are of the drive's steps.
enum class Driver {
    one,                  ///< always
    theta_e,              ///< outdoor temperature [degC]
    temperature_to_base,  ///< 20 degC - theta_e [K]
    root_of_difference,   ///< sqrt |20 degC - theta_e| [K^0.5]
    sky_difference,       ///< theta_e - theta_sky [K]
    wind,                 ///< [m/s]
    relative_wind,        ///< over its mean in the weather, less 1; at least -0.6 [-]
    wind_and_difference,  ///< wind x |20 degC - theta_e| [K m/s]
    sun_horizontal,       ///< global [W/m2]
    sun_on_facade,        ///< on the hook's facade [W/m2]
    sunniest_window,      ///< the largest on a window of the zones [W/m2]
    sunniest_room,        ///< the same, of which rooms keep some from hour to hour [W/m2]
    moisture,             ///< outdoor humidity ratio [g/kg]
    ground,               ///< outdoor temperature of the last months, lagged [degC]
    yearly_mean,          ///< outdoor temperature, mean of the calendar year [degC]
    occupied,             ///< share of the largest density of people [-]
    plant_start,          ///< rise of the set-point's schedule within the last hour [-]
    hour,                 ///< hour of the day, 0 to 24; `within` gives a share of a step
    weekend,              ///< 1 on Saturday and Sunday
    saturday,
    sunday,
    day_of_year,   ///< 0 to 366
    elapsed,       ///< years since the first step of the period
    bright,        ///< sun on the facade [W/m2]: for blinds
    heating_load,  ///< heating power of the model over Effect::full_load [-]
    cooling_load,  ///< cooling power, likewise [-]
    another_day,   ///< hook operation: schedules of the weekday in Shape::at (0 = Monday)
    shifted_hours,         ///< hook operation: schedules Shape::at hours later
    constant_temperature,  ///< hook neighbour: Shape::at [degC]
    column                 ///< a column of the job's own
};

enum class Form {
    linear,
    above,   ///< max(driver - at, 0)
    below,   ///< max(at - driver, 0)
    over,    ///< 1 where driver > at
    under,   ///< 1 where driver < at
    within,  ///< 1 where at <= driver < until (through midnight or New Year, too)
    lagged   ///< running mean with the time constant at [h]
};

struct Shape {
    Form form = Form::linear;
    double at = 0, until = 0;  ///< in the driver's unit
};

enum class Gate {
    always,
    occupied,
    unoccupied,
    day,  ///< 7 to 19 h
    night,
    weekend,
    weekday,
    heating_season,  ///< outdoor temperature of the last week below 12 degC
    cooling_season,  ///< above 16 degC
    on_days,         ///< on the days of Effect::days
    eu_summer_time,  ///< while it is in force, whatever the building's clock does
    us_summer_time
};

/// A run of days in [first, last], days since 1970; every year when yearly.
struct Days {
    int first = 0, last = 0;
    bool yearly = false;
    bool of_calendar = false;  ///< of Effect::calendar
};

/// Hours of the day in [from, until), through midnight where from > until.
struct Hours {
    double from = 0, until = 24;
};

/// Hours that a schedule has in place of those declared: its row of the drive is another
/// one, for all that follow it. They are there or not, with a coefficient of 1.
struct OtherHours {
    std::string schedule;      ///< its name
    int profile = -1;          ///< its row of Drive::profiles
    int numbers = -1;          ///< the row of its hours as physics::numbered_hours
    double low = 0, high = 1;  ///< outside of its hours, within them
    physics::WeekHours hours{}, declared{};
};

struct Effect {
    std::string name{};  ///< "wind infiltration"; of the grammar: a sentence
    int number = 0;      ///< row of the catalogue; 0 = of the grammar
    Hook hook = Hook::gains;
    Driver driver = Driver::one;
    Shape shape{};
    Gate gate = Gate::always;
    std::vector<Days> days{};  ///< of Gate::on_days
    std::string calendar{};    ///< whose public holidays some of them are: "US"
    /// Its only facade (a plane); none = every one, each by the sun that it sees itself.
    std::optional<int> facade{};
    std::optional<physics::Quantity> meter{};  ///< of a hook at a meter
    std::string place_name{};    ///< of these in words: "south facade", "gas meter"
    std::string column{};        ///< of Driver::column
    double least = 0, most = 1;  ///< plausible coefficients
    double typical = 0.5;        ///< a middling one: where secants are taken
    int weekday = -1;            ///< only on this one, 0 = Monday; -1 = on all
    Hours hours{};               ///< only in these
    bool is_smooth = false;      ///< its profile is not rounded to few levels
    double full_load = 0;        ///< of a load that it follows [W]; 0 = the place's own
    std::optional<OtherHours> other_hours{};  ///< then nothing else of it has a say

    bool is_named() const { return number != 0; }
};

/// Whether they bring the same: hook, driver, shape, gate, days, hours, facade and meter.
bool are_equal(const Effect& a, const Effect& b);
/// Whether both are other hours than declared, of the same days and the same: one habit
/// that several schedules have.
bool changed_alike(const Effect& a, const Effect& b);

/// Whether what two effects bring there is the sum of what each brings, so that parts of
/// one can be sampled.
bool adds_up(Hook hook);

/// Whether heating and cooling loads stay as they are where it changes something, so that
/// what enters there may follow them.
bool leaves_loads(Hook hook);
/// Whether people do it in all seasons: a date can be told from a season there.
bool is_use(Hook hook);
/// Whether it is the model's own heating or cooling load.
bool follows_loads(Driver driver);

/// Whether it enters at one meter, which the others do not see.
bool is_at_a_meter(Hook hook);

const char* name_of(Hook hook);
const char* name_of(Driver driver);
const char* name_of(Form form);
const char* name_of(Gate gate);
const char* unit_of(Hook hook);
const char* unit_of(Driver driver);  ///< "" where it has none
/// Of the coefficient: "1/h per m/s".
std::string unit_of(const Effect& effect);
/// Whether `at` says anything: where a form has a threshold, or the driver or the hook a
/// number of its own.
bool has_threshold(const Effect& effect);
/// Whether it may be of one facade: it acts on windows, or follows the sun on them.
bool has_facades(const Effect& effect);
/// How far the first move of its threshold, date or hour goes where a search moves it, in
/// the driver's unit; 0 = it stays where it is.
double first_move(const Effect& effect);
/// "wind above 3 m/s, at night, south facade": driver, shape, gate and place in words.
std::string sentence_of(const Effect& effect);

}  // namespace bemcal::effects
