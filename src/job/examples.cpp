/// Jobs in which every key of a job file stands once: the examples of `describe`. Each is
/// whole, and a test reads all of them.
/// Names and numbers are made up; the files that they name come with the test.
#include "job/examples.hpp"

namespace bemcal::job {

namespace {

// clang-format off
constexpr ExampleJob jobs[] = {
{"office.toml", R"toml(name = "office"                       # default: the file's name
seed = 7
structure = ["surfaces"]

[holidays]
country = "DE"
state = "BY"
days = ["2021-02-15", "12-24/01-02"]
school = ["2021-02-15/2021-02-19"]

[site]
latitude = 48.1
longitude = 11.6
utc_offset = 1                        # [h]
elevation = 520                       # [m]
albedo = 0.2

[weather]
format = "csv"
files = ["weather.csv"]
time = "time"
temperature = "as_read"
sky = "perez"
fill_gaps = 3                         # [h]

[weather.columns]
outdoor_temperature = "T_out_C"
direct_normal = "DNI"
diffuse_horizontal = "DHI"
wind_speed = {column = "wind_kmh", unit = "km/h"}
relative_humidity = "RH"
cloud_cover = "cloud"
infrared = "IR"

[weather.columns.global_horizontal]
column = "GHI"
unit = "W/m2"
factor = 1.02                         # of a sensor that reads too little
offset = 0
stamp = "start"

[periods]
training = ["2021-01-01", "2021-01-31"]
held_out = ["2021-02-01", "2021-02-14"]
later = ["2021-02-15", "2021-02-28"]

[run]
step = 3600                           # [s]
warm_up_days = 14

[[schedule]]
name = "work"
weekdays = [0, 0, 0, 0, 0, 0, 0, 0.2, 0.9, 1, 1, 1, 0.7, 1, 1, 1, 1, 0.6, 0.2, 0, 0, 0, 0, 0]
weekend = 0
holiday = 0
holidays = ["01-01", "01-06"]
summer_time = "eu"

[[schedule.period]]
dates = "07-15/08-15"
every_day = 0

[[schedule]]
name = "persons"                      # of each day, by a register
every_day = 0
monday = [0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1, 1, 0, 0, 0, 0, 0, 0, 0]
tuesday = [0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1, 1, 0, 0, 0, 0, 0, 0, 0]
wednesday = [0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1, 1, 0, 0, 0, 0, 0, 0, 0]
thursday = [0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1, 1, 0, 0, 0, 0, 0, 0, 0]
friday = [0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0]
saturday = 0
sunday = 0
register = "persons.csv"
register_column = "persons"

[[schedule]]
name = "plant"                        # nobody wrote its hours down
hours = "learn"
use = "office"

[[series]]
name = "rain"
file = "rain.csv"
column = "Rain"
unit = "mm/h"
factor = 1
offset = 0
fill_gaps = 6                         # [h]
time = "Time"
time_format = "%d.%m.%Y %H:%M"
clock = "standard"
decimal = ","
thousands = "none"
missing = ["Bad", -999]
header_line = 2
skip = ["Total"]
gaps = "missing"

[[construction]]
name = "wall"
u_value = 0.8                         # [W/(m2 K)]
solar_absorptance = 0.5
emissivity = 0.9
external_resistance = 0.04            # [m2 K/W]

[[construction]]
name = "roof"
u_value = 0.4

[[construction]]
name = "floor"
u_value = 0.5

[[glazing]]
name = "double"
u_value = 2.8
solar_transmittance = 0.6
frame_fraction = 0.25
incidence_factor = 0.9
emissivity = 0.84
external_resistance = 0.04

[[glazing]]
name = "triple"
u_value = 1.1
solar_transmittance = 0.5
angle_modifier = [1, 0, -0.1]         # a polynomial in the angle of incidence [rad]

[[boundary]]
name = "ground"
temperature = 10                      # [degC]

[[zone]]
name = "office"
class = "heavy"
floor_area = 1200                     # [m2]
volume = 3600                         # [m3]
heat_capacity = 260000                # [J/(m2 K)], in place of the class's
mass_area_ratio = 3
surface_area_ratio = 4.5
surface_film = 3.45
mass_film = 9.1
gains_air_share = 0.5
sun_air_share = 0.1
bridge_conductance = 20               # [W/K]
sky_temperature_difference = 11       # [K]
heating_set_point = {value = 21, low = 15, schedule = "plant"}
cooling_set_point = {value = 25, low = 35, schedule = "plant"}
heating_capacity = 60                 # [W/m2]
cooling_capacity = 50                 # [W/m2]
heating_available = 1
cooling_available = {value = 1, low = 0, schedule = "plant"}
air_capacity = 15000                  # [J/(m2 K)]
proportional_band = 0.5               # [K]
room_spread = {value = 4, low = 2, schedule = "work"}  # [K]
cooled_together = {value = 0, low = 1, schedule = "plant"}
emitter_time_constant = 1200          # [s]
emitter_radiant_share = 0.4
heating_limit = 16                    # [degC] of the running mean outdoors
cooling_limit = 12
second_mass_conductance = 2           # [W/(m2 K)]
second_mass_capacity = 200000         # [J/(m2 K)]
venting_air_change = {value = 2, schedule = "work"}
venting_opens_above = 24              # [degC]
venting_band = 1                      # [K]
supply_shift = 0.5                    # [K]
opaque_shift = 0
window_shift = 0

[[zone.surface]]
name = "south"
construction = "wall"
area = 300                            # [m2]
azimuth = 180
shading_factor = 0.9

[[zone.surface]]
construction = "roof"
area = 300
azimuth = 0
tilt = 0

[[zone.surface]]
construction = "floor"
area = 300
boundary = "ground"
in_sun = false

[[zone.surface]]
name = "to the stairs"
construction = "wall"
area = 80
adjustment = 0.5                      # half of the loss to outdoors
in_sun = false

[[zone.window]]
name = "south"
glazing = "double"
area = 100
azimuth = 180
tilt = 90
shading_factor = 0.8

[[zone.window]]
glazing = "triple"
area = 80
azimuth = 0

[[zone.flow]]
name = "infiltration"
air_change = 0.4                      # [1/h]

[[zone.flow]]
name = "ventilation"
air_change = {value = 1, schedule = "plant"}
heat_recovery = 0.6

[[zone.flow]]
name = "from the cellar"
air_change = 0.05
supply = "ground"

[[zone.load]]
name = "people"
density = {value = 0.3, schedule = "persons"}   # [W/m2] for each person

[[zone.load]]
name = "equipment"
density = {value = 12, low = 3, schedule = "work"}
carrier = "electricity"
heat_fraction = 0.9
efficiency = 1

[[zone.load]]
name = "pump of the rain tank"
density = {series = "rain", value = 0.1}
carrier = "electricity"

[plant]
heating_carrier = "gas"
heating_efficiency = 0.9
heating_auxiliary = 0.01
cooling_carrier = "electricity"
cooling_cop = 3.5
cooling_auxiliary = 0.01
heating_least_load = 15               # [W/m2], below which the boiler goes on and off
heating_cycling_loss = 0.1
cooling_least_load = 20
cooling_cycling_loss = 0.15

[[meter]]
name = "gas"
quantity = "gas"
file = ["meters.csv"]
column = "gas_kwh"
unit = "kWh"
tariff = 0.09                         # [1/kWh], of any currency
co2 = 0.2                             # [kg/kWh]
mask = ["2021-01-20/2021-01-21"]
zeros = "check"
zero_run = 24                         # [h]
constant = "check"
constant_run = 24                     # [h]
steps = "check"
codes = "check"
spikes = "check"
negative = "check"
register = "check"

[[meter.scale]]
from = "2021-01-25"
to = "2021-01-28"
factor = 1.1

[[meter]]
name = "electricity"
quantity = "electricity"
file = "meters.csv"
column = "electricity_kwh"
unit = "kWh"
interval = "daily"
time = "time"
stamp = "start"
utc_offset = 1                        # [h], of the file's clock

[[meter]]
name = "heat"
quantity = "heating"
interval = "monthly"
file = "bills.csv"
column = "heat_mwh"
unit = "MWh"
factor = 0.95                         # losses of the pipes
from = "from"
to = "to"
estimated = "read"

[[meter]]
name = "room"
quantity = "air_temperature"
file = "meters.csv"
column = "room_degc"
unit = "degC"

[[effect]]
name = "wind infiltration"            # a row of the catalogue
coefficient = 0.02

[[effect]]
name = "warm evenings"
hook = "heating set-point"
gate = "night"
weekday = "friday"
hours = [19, 23]
coefficient = 2                       # [K]

[[effect]]
name = "sauna"
hook = "meter addition"
meter = "electricity"
days = ["2021-01-10/2021-01-12"]
coefficient = 1

[[effect]]
name = "blind"
hook = "aperture"
facade = "south"
driver = "outdoor temperature"
form = "within"
at = 5                                # [degC]
until = 18
coefficient = -0.05

[[effect]]
name = "new tenant"
hook = "gains"
driver = "time elapsed"
since = "2021-01-11"
since_within = 5                      # [d] a posterior samples the day
coefficient = 1                       # [W/m2]

[[effect]]
name = "part-load efficiency of heating"
full_load = 12                        # [kW] the heating load that counts as 1
coefficient = -0.3

[[effect]]
name = "wet air"
hook = "infiltration"
driver = "column"
series = "rain"
coefficient = 0.05

[[effect]]
name = "cold days"
hook = "gains"
coefficient = 1

[[effect.function]]
driver = "outdoor temperature"
at = [-5, 5, 15]
values = [1, 0.5, 0]
spread = 0.4                          # [W/m2] a posterior samples the values

[[parameter]]
name = "infiltration"
target = "zone.office.flow.infiltration.air_change"
min = 0.1
max = 1
prior = {kind = "lognormal", median = 0.4, sd_log = 0.3}

[[parameter]]
name = "walls"
target = ["construction.wall.u_value", "construction.roof.u_value"]
mode = "factor"
min = 0.5
max = 1.5
prior = {kind = "beta", alpha = 2, beta = 2}

[[parameter]]
name = "set_point"
target = "zone.office.heating_set_point"
min = 19
max = 23
value = 20.5                          # where a study does not vary it
prior = {kind = "normal", mean = 0.5, sd = 0.2, normalised = true}

[[parameter]]
name = "equipment"
target = "zone.office.load.equipment.density"
min = 5
max = 25
prior = {kind = "gamma", shape = 9, rate = 0.75}

[[parameter]]
name = "efficiency"
target = "plant.heating_efficiency"
values = [0.8, 0.85, 0.9, 0.95]

[[parameter]]
name = "by_wind"
target = "effect.wind infiltration"
min = 0
max = 0.1
prior = {kind = "fixed", value = 0.02}

[[study]]
kind = "sensitivity"
period = "training"
quantities = ["heating", "gas"]
n_base = 64
scramble = true
n_bootstrap = 100
threshold = 0.05

[[study]]
kind = "hourly_sensitivity"
period = "held_out"
quantity = "heating"
n_base = 64
scramble = true

[[study]]
kind = "screening"
n_points = 4096
points_per_item = 512
keep_points = true
n_best = 20

[[study]]
kind = "posterior"
name = "believed"
period = "training"
parameters = ["infiltration", "walls", "set_point"]
meters = ["gas", "electricity"]
hold_out_weeks = 0.2
hold_out_hours = 0.1
n_predictive = 200
autocorrelated = false
proportional = false
discrepancy = false
level_change = 0.06
lasting_weeks = 2
reading_weight = 0.006
sampler = "nuts"
n_chains = 8
warm_up = 300
draws_per_round = 100
most_draws = 2000
thin = 1
target_rhat = 1.01
target_ess = 400
temperatures = [1, 2, 4]

[[study]]
kind = "loop"
period = "training"
parameters = ["infiltration", "walls", "set_point", "equipment"]
meters = ["gas", "electricity"]
most_effects = 4
try_structures = false
block_days = 7
least_gain = 2                        # [%]
most_loss = 1                         # [%]
alpha = 0.01
exclude = ["night purge"]
generic = true
functions = true
level_change = 0.1
columns = ["rain"]

[[study]]
kind = "optimisation"
name = "best"
period = "training"
parameters = ["infiltration", "walls"]
meters = ["gas", "electricity"]
method = "swarm_then_pattern"
objective = "percent"
cv_weight = 0.7
r2_weight = 0.3
meter_weights = [1, 0.5]
resolution = "own"
evaluations = 2000
n_particles = 32
restart = true

[[study]]
kind = "optimisation"
name = "trade_offs"
method = "nsga2"
errors = "cv_rmse"
meters = ["gas", "electricity"]
n_population = 40
n_generations = 20

[[study]]
kind = "optimisation"
name = "to_bills"
method = "pattern"
evaluations = 500

[[study.target]]
quantity = "electricity"
statistic = "period"
meter = "electricity"
scale = 2                             # [%]

[[study.target]]
quantity = "heating"
statistic = "months"
measured_months = [28]                # one for each month of the period
unit = "MWh"

[[study]]
kind = "grid"
name = "bills"
period = "training"
k = 5
k_rule = "given"
radius = 4                            # [%]
density_threshold = 0.01
distance = "scaled"
target_error = 1                      # [%]
most_stages = 4
budget = 2000
threshold = 0.05
points_per_item = 64

[study.grid]
infiltration = [0.2, 0.4, 0.6]
walls = [0.8, 1, 1.2]

[[study.stage]]
infiltration = [0.3, 0.4, 0.5]
walls = [0.9, 1, 1.1]

[[study.target]]
quantity = "electricity"
statistic = "period"
meter = "electricity"
scale = 2                             # [%]

[[study.target]]
quantity = "electricity"
statistic = "peak"
measured = 25
unit = "kW"

[[study.target]]
quantity = "heating"
statistic = "months"
measured_months = [28000]             # [kWh], one for each month of the period

[[study]]
kind = "stages"
name = "in_steps"
at_once = true
at_once_evaluations = 1000
accuracy = 0.35
independent_hours = 24
beside = ["believed"]
meters = ["gas"]
method = "pattern"
objective = "likelihood"
cv_weight = 0.7
r2_weight = 0.3
meter_weights = [1]
resolution = "own"
evaluations = 1000
n_particles = 32
restart = true

[[study.stage]]
name = "winter"
periods = ["training"]
parameters = ["infiltration"]
from = "initial"
around = 0.5
set = {walls = 1}
evaluations = 500
seed = 3
meters = ["gas"]
meter_weights = [1]
objective = "likelihood"

[[study.stage]]
name = "walls"
periods = ["training"]
parameters = ["walls"]
ranges = {walls = [0.8, 1.2]}

[[study.validation]]
period = "held_out"
stage = "walls"

[[study]]
kind = "retrofit"
of = "believed"
n_predictive = 100
period = "training"
occupied = "work"
too_cold = 19                         # [degC]
too_warm = 26                         # [degC]

[[scenario]]
name = "insulation"
[[scenario.change]]
target = "construction.wall.u_value"
insulation = 0.12                     # [m]
conductivity = 0.035                  # [W/(m K)]
[[scenario.change]]
target = "zone.*.flow.infiltration.air_change"
factor = 0.7

[[scenario]]
name = "heat pump"
heating_carrier = "electricity"
[[scenario.change]]
target = "plant.heating_efficiency"
value = 3.2
[[scenario.change]]
target = "zone.*.heating_set_point"
offset = -1                           # [K]

[output]
file = "office.h5"
hourly = ["gas", "air_temperature"]
max_failed_share = 0.05
)toml"},

{"villa.toml", R"toml(weather = {files = ["2021.epw"], year = 2021, format = "epw", temperature = "hour_mean", sky = "hay_davies"}
periods = {training = ["2021-01-01", "2021-01-31"], held_out = ["2021-02-01", "2021-02-28"]}
holidays = ["12-24/01-06", "2021-02-15"]

[[schedule]]
name = "heating"
every_day = [0, 0, 0, 0, 0, 0, 1, 1, 1, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 0, 0]

[[series]]
name = "supply"                       # [degC], as measured
file = "boiler.csv"
column = "supply_degc"

[[construction]]
name = "wall"

[[construction.layer]]
name = "insulation"                   # the first is outside
thickness = 0.08
conductivity = 0.04
density = 30
specific_heat = 1400

[[construction.layer]]
name = "brick"
thickness = 0.24                      # [m]
conductivity = 0.8                    # [W/(m K)]
density = 1800                        # [kg/m3]
specific_heat = 1000                  # [J/(kg K)]

[[construction]]
name = "roof"
u_value = 0.4
internal_resistance = 0.1             # [m2 K/W]

[[glazing]]
name = "double"
u_value = 2.8
solar_transmittance = 0.6
type = 1

[[zone]]
name = "living"
class = "layers"
floor_area = 80
volume = 200

[zone.radiator]
elements = 3
nominal_power = 6000                  # [W] at 60 K above the room
exponent = 1.3
heat_capacity = 80000                 # [J/K]
radiative_fraction = 0.3
maximum_flow = 0.08                   # [kg/s]
curve_a = -1.1                        # supply = a theta_e + b
curve_b = 54
curve_c = 43
curve_d = 22
curve_limit = 10                      # [degC]
set_back_below = 14                   # [degC]
scheduled = {value = 1, schedule = "heating"}
supply_measured = 1
supply_temperature = {series = "supply"}
flow = 1

[[zone.surface]]
construction = "wall"
area = 90
azimuth = 180

[[zone.window]]
glazing = "double"
area = 15
azimuth = 180

[[zone.coupling]]
zone = "study"
conductance = 30                      # [W/K]
air_flow = 20                         # [m3/h]

[[zone]]
name = "study"
floor_area = 20
volume = 50

[[zone.surface]]
construction = "roof"
area = 20
azimuth = 0
tilt = 0

[[zone.flow]]
name = "ventilation"
air_change = 0.5

[[zone]]
name = "workshop"
floor_area = 40
volume = 120

[[zone.flow]]
name = "ventilation"
air_change = 0.5

[[zone.surface]]
construction = "roof"
area = 40
azimuth = 0
tilt = 0

[[boundary]]
name = "duct"
temperature = 13                      # [degC] of supply air

[[zone]]
name = "shop"                         # its terminals bring the least supply air
floor_area = 40
volume = 120

[[zone.flow]]
name = "least"
supply = "duct"
air_change = {value = 1.5, schedule = "heating"}

[[zone.surface]]
construction = "roof"
area = 40
azimuth = 0
tilt = 0

[[zone]]
name = "test room"                    # whose heat is known
floor_area = 20
volume = 50
imposed_power = {value = 20, schedule = "heating"}   # [W/m2]

[[zone.surface]]
construction = "roof"
area = 20
azimuth = 0
tilt = 0

[[air_system]]
name = "rooftop unit"
zones = ["study"]
flow = "ventilation"
volume = "variable"
available = {value = 1, schedule = "heating"}
design_flow = 15                      # [m3/(h m2)]
least_flow = 0.3
fan_power = 1.5                       # [W/(l/s)]
fan_exponent = 2.5
fan_heat = 1
supply_temperature = 13               # [degC]
supply_reset = 0.3                    # [K/K]
reset_below = 20                      # [degC]
most_reset = 5                        # [K]
people_moisture = 3                   # [g/(h m2)]
bypass_factor = 0.1
economiser = 1
economiser_by = "dry_bulb"
economiser_limit = 20                 # [degC]
frost_limit = -5                      # [degC]
least_humidity = 4                    # [g/kg]

[[air_system]]
name = "terminals"
zones = ["shop"]
flow = "least"
available = {value = 1, schedule = "heating"}
outdoor_air_change = {value = 0.5, schedule = "heating"}  # [1/h] in the supply air

[[air_system]]
name = "split"
zones = ["workshop"]
volume = "constant"
coil_enthalpy = 12                    # [kJ/kg]

[[link]]
target = "construction.wall.layer.brick.conductivity"
of = "construction.wall.layer.brick.density"

[[link.term]]
factor = 0.0004
exponents = [1]

[[link.term]]
factor = 0.08

[[link]]
target = ["glazing.double.u_value", "glazing.double.solar_transmittance"]
of = "glazing.double.type"

[[link.row]]
key = 1
values = [2.8, 0.6]

[[link.row]]
key = 2
values = [1.1, 0.5]

[[parameter]]
name = "density"
target = "construction.wall.layer.brick.density"
min = 1200
max = 2000

[[parameter]]
name = "glazing"
target = "glazing.double.type"
values = [1, 2]

[[study]]
kind = "sensitivity"
n_base = 64
)toml"},

{"street.toml", R"toml(buildings = ["one.toml", "two.toml"]  # each with zones, meters, parameters

[weather]
files = ["2021.epw"]

[periods]
training = ["2021-01-01", "2021-01-31"]
held_out = ["2021-02-01", "2021-02-28"]

[[study]]
kind = "posterior"
pooling = "partial"
unseen = ["two"]
)toml"},

{"program.toml", R"toml([simulator]
command = ["python3", "house.py", "house.json", "@outdoor@"]
shell = false
files = ["house.py"]
time_limit = 60                       # [s]
output_limit = 10                     # [MB]
keep = "failed"
folder = "program.points"

[[simulator.template]]
file = "house.json.in"                # with @u_value@ in it
as = "house.json"

[[simulator.parameter]]
name = "u_value"
unit = "W/(m2 K)"
min = 0.2
max = 1.6
nominal = 0.8

[[simulator.parameter]]
name = "outdoor"
unit = "degC"
min = -5
max = 20

[[simulator.output]]
name = "gas"
unit = "kWh"
file = "gas.csv"
column = "gas [kWh]"
header = 1
skip = 1                              # a line of units
take = "sum"
rows = 8760                           # a run that stopped in autumn has failed
factor = 1.05
offset = 0

[[simulator.output]]
name = "heat_loss"
unit = "W/K"
pattern = "heat loss: ([0-9.]+)"      # in what it prints
row = 1

[[study]]
kind = "sensitivity"
n_base = 1024
runs = 40                             # then an emulator answers the points

[[study]]
kind = "kennedy_ohagan"
name = "bills"
field = "bills_by_month.csv"
field_output = "gas"
inputs = ["outdoor"]
calibrated = ["u_value"]
simulator = "command"
n_designs = 20

[[study]]
kind = "optimisation"
method = "pattern"
evaluations = 200
runs = 40

[[study.target]]
output = "gas"
measured = 21000

[[study]]
kind = "grid"
k = 2
runs = 40

[study.grid]
u_value = [0.4, 0.8, 1.2]

[[study.target]]
output = "gas"
measured = 21000
)toml"},

{"twin.toml", R"toml(plant = {heating_carrier = "gas", heating_efficiency = 0.9}
construction = [{name = "wall", u_value = 0.8}]
zone = [{name = "house", floor_area = 100, volume = 250, surface = [{construction = "wall", area = 200, azimuth = 0}]}]
meter = [{name = "gas", quantity = "gas", file = "meters.csv", column = "gas_kwh", unit = "kWh"}]
parameter = [{name = "walls", target = "construction.wall.u_value", min = 0.4, max = 1.6}]
weather = {files = ["2021.epw"], year = 2021}
periods = {training = ["2021-01-01", "2021-01-31"], held_out = ["2021-02-01", "2021-02-28"]}

[simulator]                           # the user's own model of the same house
command = ["python3", "house.py", "house.json"]
files = ["house.py", "days.csv"]
periods = "days.csv"                  # written for each run: the periods it is needed for

[[simulator.template]]
file = "house.json.in"                # with @u_value@ in it
as = "house.json"

[[simulator.parameter]]
name = "u_value"
unit = "W/(m2 K)"
min = 0.4
max = 1.6
limits = [0.1, 1.6]                   # that a scenario may make of it

[[simulator.hourly]]
meter = "gas"
file = "hours.csv"                    # a row for each hour of these periods
column = "gas"
header = 1
skip = 1                              # a line of units
factor = 0.001                        # Wh to kWh
offset = 0

[[simulator.template]]                # of a program that reads no effects.toml:
file = "hours.dat.in"                 # with @more_air@, @gas_more@ and @shade@ in it

[[simulator.effect]]
name = "more_air"                     # a number for each hour, a line each
hook = "infiltration"                 # added [1/h]

[[simulator.effect]]
name = "gas_more"
hook = "meter factor"                 # the meter's times 1 + number
meter = "gas"

[[simulator.effect]]
name = "shade"
hook = "aperture"
facade = "south facade"

[[study]]
kind = "loop"
runs = 60

[[study]]
kind = "posterior"
runs = 60

[[study]]
kind = "screening"
runs = 60

[[study]]
kind = "stages"
runs = 60

[[study.stage]]
name = "walls"
periods = ["training"]
parameters = ["u_value"]

[[study]]
kind = "retrofit"                     # the program runs before and after
of = "loop"

[[scenario]]
name = "insulated and sealed"

[[scenario.change]]
target = "u_value"                    # a [[simulator.parameter]]
insulation = 0.14                     # [m] more
conductivity = 0.035

[[scenario.change]]
target = "effect.wind infiltration"   # that the loop found: struck, or scaled by factor
value = 0
)toml"},

{"office_hour.toml", R"toml([[study]]
kind = "office_hour_sensitivity"
n_base = 1024
scramble = true
n_bootstrap = 200
threshold = 0.05

[study.fixed]                         # a case for each value
theta_ext = [10, 30]

[[study]]
kind = "kennedy_ohagan"
name = "from_runs"
field = "field.csv"
field_output = "y"
inputs = ["x"]
runs = "runs.csv"
runs_output = "eta"
calibrated = ["t"]
output_factor = 542.8
output_offset = 2051
output_unit = "kWh"
hyperpriors = "chong"
regression_factor = false
mean = "constant"
mean_coefficients = "integrated"
form = "auto"
n_predictive = 500
sampler = "nuts"
temperatures = [1]
n_chains = 8
warm_up = 300
draws_per_round = 100
most_draws = 2000
thin = 1
target_rhat = 1.01
target_ess = 400

[study.prior]
t = {kind = "normal", mean = 0.5, sd = 0.2, normalised = true}

[[study]]
kind = "kennedy_ohagan"
name = "from_the_hour"
field = "hours.csv"
field_output = "energy"
inputs = ["GFA", "theta_ext"]
calibrated = ["WWR", "theta_H_set", "theta_C_set"]
simulator = "office_hour"
n_designs = 50

[study.fixed]                         # what is neither known nor calibrated
DayNum = 15
HourNum = 10
L = 40
W = 30
h = 3.3
Orie = 0
U_window = 2.8
U_wall = 0.8
U_roof = 0.8
Ven_M = 2
DHI = 100
DNI = 200
theta_prev = 20
phi_int = 10
)toml"},

{"town.toml", R"toml([stock]
table = "town.csv"                    # name, floor_area, floors, weather, gas, gas_column, ...
recent_days = 14
window_days = 365
budget = 1000000                      # simulations of a night
hours = 6
drift_value = 0.2
drift_error = 1.5
keep_results = false
false_alarms = 0.002                  # in a week, where nothing changes (of a loop)

[[study]]
kind = "screening"
n_points = 256
)toml"},

{"streets.toml", R"toml([stock]
folder = "buildings"                  # each *.toml in it is a building

[weather]
files = ["2021.epw"]

[periods]
training = ["2021-01-01", "2021-01-31"]
held_out = ["2021-02-01", "2021-02-28"]

[[study]]
kind = "loop"
)toml"},

{"houses.toml", R"toml([stock]
table = "houses.csv"                  # name, weather, area, gas
template = "house.toml"               # with @weather@, @area@ and @gas@ in it

[periods]
training = ["2021-01-01", "2021-01-31"]
held_out = ["2021-02-01", "2021-02-28"]

[[study]]
kind = "screening"
)toml"},
};
// clang-format on

}  // namespace

std::span<const ExampleJob> example_jobs() {
    return jobs;
}

}  // namespace bemcal::job
