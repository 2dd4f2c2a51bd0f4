#!/usr/bin/python3
"""`bemcal-batch new --idf` reads a building of ours from an EnergyPlus file: areas, directions, U-values, glazing,
schedules, loads, air, set-points and plant, alike from IDF and epJSON; what is wrong in it ends in one message.

The layout of fields is checked against EnergyPlus's own schema where that is there (tests/energyplus/idf.py).
"""
import datetime as dt
import json
import pathlib
import re
import shutil
import sys
import tempfile
import types
import unittest

sys.dont_write_bytecode = True
ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "scripts"), str(ROOT / "tests" / "scripts"), str(ROOT / "tests" / "energyplus")]

import idf as energyplus  # noqa: E402  (found above)
import numpy as np  # noqa: E402
import test_new as usual  # noqa: E402
from new_job import (  # noqa: E402
    building, idf, idf_building, idf_envelope, idf_fields, idf_geometry, idf_outside, idf_plant, idf_room,
    idf_schedules, idf_use)
from new_job.refused import Refused, Told  # noqa: E402

DATA, NO_INPUT, USAGE = 65, 66, 64
LENGTH, DEPTH, HEIGHT, NORTH, ALIKE = 10, 8, 3, 30, 2
OUTSIDE, INSIDE, UP, DOWN = 0.02994, 0.11976, 0.10743, 0.16202   # m2 K/W: films of ASHRAE 90.1 A9.4.1
# Corners of each face, seen from outside against the clock.
FACES = {
    "south": ("Wall", "Wall", "Outdoors", "0,0,3, 0,0,0, 10,0,0, 10,0,3"),
    "east": ("Wall", "Wall", "Outdoors", "10,0,3, 10,0,0, 10,8,0, 10,8,3"),
    "north": ("Wall", "Wall", "Outdoors", "10,8,3, 10,8,0, 0,8,0, 0,8,3"),
    "west": ("Wall", "Wall", "Adiabatic", "0,8,3, 0,8,0, 0,0,0, 0,0,3"),
    "roof": ("Roof", "Roof", "Outdoors", "0,8,3, 0,0,3, 10,0,3, 10,8,3"),
    "floor": ("Floor", "Slab", "Ground", "0,0,0, 0,8,0, 10,8,0, 10,0,0"),
}
HOUSE = f"""! A box of two zones that are alike
Version, 25.2;
Building, Box, {NORTH}, Suburbs;   ! its y axis points to 30 deg
GlobalGeometryRules, UpperLeftCorner, Counterclockwise, Relative;
Zone, Room, 0, 5, 5, 0, 1, {ALIKE}, autocalculate, autocalculate, ;
Material, Brick, Rough, 0.24, 0.8, 1800, 900, 0.9, 0.65, 0.65;
Material, Concrete, Rough, 0.2, 2, 2400, 1000;
Material:NoMass, Wool, Rough, 2.5;
Construction, Wall, Brick, Wool, Brick;
Construction, Roof, Wool, Concrete;
Construction, Slab, Concrete;
Construction, Window, Pane;
WindowMaterial:SimpleGlazingSystem, Pane, 1.8, 0.45;
FenestrationSurface:Detailed, South window, Window, Window, south, , , , 3, 4, 1,0,2.5, 1,0,1, 2,0,1, 2,0,2.5;
Schedule:Constant, Activity, , 120;
Schedule:Compact, Work, Fraction, Through: 6/30, For: Weekdays SummerDesignDay, Until: 8:00, 0, Until: 17:30, 1,
  Until: 24:00, 0, For: Saturday, Until: 24:00, 0.25, For: AllOtherDays, Until: 24:00, 0,
  Through: 12/31, For: AllDays, Until: 24:00, 0.5;
Schedule:Day:Hourly, Day, , 16,16,16,16,16,16,21,21,21,21,21,21,21,21,21,21,21,21,21,21,16,16,16,16;
Schedule:Day:Interval, Off, , No, 24:00, 16;
Schedule:Week:Daily, Week, Off, Day, Day, Day, Day, Day, Off, Off, Day, Day, Day, Day;
Schedule:Year, Heat, , Week, 1, 1, 12, 31;
Schedule:Constant, Cool, , 26;
People, People, Room, Work, Area/Person, , , 10, 0.3, 0.5, Activity;
Lights, Lights, Room, Work, Watts/Area, , 8;
ElectricEquipment, Plugs, Room, Work, EquipmentLevel, 400, , , 0.1, 0.3, 0.2;
ZoneInfiltration:DesignFlowRate, Leaks, Room, , AirChanges/Hour, , , , 0.5, 0.6, 0.04, 0, 0;
DesignSpecification:OutdoorAir, Fresh, Sum, 0.005, 0.0005;
Sizing:Zone, Room, SupplyAirTemperature, 13, , SupplyAirTemperature, 40, , 0.008, 0.008, Fresh;
ZoneControl:Thermostat, Control, Room, Activity, ThermostatSetpoint:DualSetpoint, Both;
ThermostatSetpoint:DualSetpoint, Both, Heat, Cool;
Coil:Heating:Fuel, Burner, , NaturalGas, 0.82;
Coil:Cooling:DX:SingleSpeed, Cooler, , autosize, autosize, 3.4;
Shading:Site:Detailed, Tree, , 4, 0,0,0, 0,1,0, 0,1,1;
"""


def without(text, *beginnings):
    """A file without the objects of some classes, each of which is a line."""
    return "".join(line + "\n" for line in text.splitlines() if not line.startswith(beginnings))


def faces(version_has_space=True):
    space = " ," if version_has_space else ""
    return "".join(f"BuildingSurface:Detailed, {name}, {kind}, {construction}, Room,{space} {outside}, , "
                   f"{'SunExposed' if outside == 'Outdoors' else 'NoSun'}, NoWind, , 4, {corners};\n"
                   for name, (kind, construction, outside, corners) in FACES.items())


BOX = HOUSE + faces()


def ideal(house=BOX, **fields):
    """The box with ideal loads in place of its coils, which stand in the zone's list of equipment, and schedules."""
    names = idf.fields_in("zonehvac:idealloadsairsystem", (25, 2))
    given = {"name": "Air", "design_specification_outdoor_air_object_name": "Fresh", **fields}
    row = ", ".join(str(given.pop(name, "")) for name in names)
    assert not given, given
    return without(house, "Coil:") + f"""
ZoneHVAC:IdealLoadsAirSystem, {row};
ZoneHVAC:EquipmentConnections, Room, List, Some list of nodes;
ZoneHVAC:EquipmentList, List, SequentialLoad, ZoneHVAC:IdealLoadsAirSystem, Air, 1, 1;
Schedule:Constant, Never, , 0;
Schedule:Compact, Summer, , Through: 4/30, For: AllDays, Until: 24:00, 0, Through: 9/30, For: AllDays, Until: 24:00, 1,
  Through: 12/31, For: AllDays, Until: 24:00, 0;
"""


# A store to its west, 10 m long, behind one wall with it.
STORE_FACES = {
    "store south": ("Wall", "Wall", "Outdoors", "", "-10,0,3, -10,0,0, 0,0,0, 0,0,3"),
    "store east": ("Wall", "Wall", "Surface", "west", "0,0,3, 0,0,0, 0,8,0, 0,8,3"),
    "store north": ("Wall", "Wall", "Outdoors", "", "0,8,3, 0,8,0, -10,8,0, -10,8,3"),
    "store west": ("Wall", "Wall", "Outdoors", "", "-10,8,3, -10,8,0, -10,0,0, -10,0,3"),
    "store roof": ("Roof", "Roof", "Outdoors", "", "-10,8,3, -10,0,3, 0,0,3, 0,8,3"),
    "store floor": ("Floor", "Slab", "Ground", "", "-10,0,0, -10,8,0, 0,8,0, 0,0,0"),
}
TWO = BOX.replace("west, Wall, Wall, Room, , Adiabatic, ,", "west, Wall, Wall, Room, , Surface, store east,") + """
Zone, Store, 0, 5, 5, 0, 1, 1;
Lights, Store lights, Store, Work, Watts/Area, , 3;
Schedule:Constant, Frost, , 12;
ZoneControl:Thermostat, Frost control, Store, Activity, ThermostatSetpoint:SingleHeating, Frost only;
ThermostatSetpoint:SingleHeating, Frost only, Frost;
""" + "".join(f"BuildingSurface:Detailed, {name}, {kind}, {of}, Store, , {outside}, {other}, "
              f"{'SunExposed' if outside == 'Outdoors' else 'NoSun'}, NoWind, , 4, {corners};\n"
              for name, (kind, of, outside, other, corners) in STORE_FACES.items())


# The same box by length and height: the azimuth is the outward normal's from the zone's y axis.
BY_LENGTH = """
Wall:Exterior, south, Wall, Room, , 180, 90, 0, 0, 0, 10, 3;
Wall:Exterior, east, Wall, Room, , 90, , 10, 0, 0, 8, 3;
Wall:Exterior, north, Wall, Room, , 0, 90, 10, 8, 0, 10, 3;
Wall:Adiabatic, west, Wall, Room, , 270, 90, 0, 8, 0, 8, 3;
Roof, roof, Roof, Room, , 180, 0, 0, 0, 3, 10, 8;
Floor:GroundContact, floor, Slab, Room, , 180, , 0, 8, 0, 10, 8;
"""


def as_json(path):
    """The same objects as EnergyPlus lays them out in JSON."""
    made = {}
    for several in idf.read_model(str(path)).objects.values():
        for k, each in enumerate(several):
            kind = each.kind.lower()
            fields = {name: value for name, value in each.fields.items() if value and name != "name"}
            if each.rest and kind in idf_fields.REST:
                key, columns = idf_fields.REST[kind]
                fields[key] = [dict(zip(columns, group)) for group in each.rest]
            made.setdefault(each.kind, {})[each.name or f"{each.kind} {k + 1}"] = fields
    return json.dumps(made)


class Box(unittest.TestCase):
    """Parts, without the program."""

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)

    def read(self, text, name="box.idf"):
        path = self.folder / name
        path.write_text(text)
        return idf_building.read_building(str(path))

    def refused(self, old, new, *words):
        """What a changed file is told."""
        self.assertIn(old, BOX)
        with self.assertRaises(Refused) as caught:
            self.read(BOX.replace(old, new))
        for word in ("box.idf", *words):
            self.assertIn(word, str(caught.exception))

    def test_areas_directions_and_multipliers(self):
        found = self.read(BOX)
        self.assertAlmostEqual(found.whole.area, ALIKE * LENGTH * DEPTH)
        self.assertAlmostEqual(found.whole.volume, ALIKE * LENGTH * DEPTH * HEIGHT)
        walls = {p.azimuth: p.area for p in found.whole.shell.surfaces.values() if p.construction == "Wall"}
        glass = 3 * 1 * 1.5
        self.assertEqual(set(walls), {210, 120, 30})
        self.assertAlmostEqual(walls[210], ALIKE * (LENGTH * HEIGHT - glass))
        self.assertAlmostEqual(walls[120], ALIKE * DEPTH * HEIGHT)
        (window,) = found.whole.shell.windows.values()
        self.assertEqual((window.azimuth, window.tilt), (210, 90))
        self.assertAlmostEqual(window.area, ALIKE * glass)
        roof = next(p for p in found.whole.shell.surfaces.values() if p.construction == "Roof")
        self.assertEqual((roof.tilt, roof.area), (0, ALIKE * LENGTH * DEPTH))
        slab = next(p for p in found.whole.shell.surfaces.values() if p.construction == "Slab")
        self.assertEqual((slab.boundary, slab.azimuth), ("ground", None))

    def test_clockwise_vertices_and_world_coordinates(self):
        turned = BOX.replace("Counterclockwise, Relative", "Clockwise, World")
        walls = {p.azimuth for p in self.read(turned).whole.shell.surfaces.values() if p.construction == "Wall"}
        self.assertEqual(walls, {0, 270, 180})     # inside out, and north stays where it is

    def test_surfaces_by_length_and_height(self):
        """EnergyPlus 25.2 gives the same areas, azimuths and tilts, whatever the coordinates are relative to."""
        window = "Window, South window, Window, south, , 3, 1, 1, 1, 1.5;\n"
        house = "".join(line + "\n" for line in HOUSE.splitlines() if not line.startswith("Fenestration"))
        one, other = self.read(BOX), self.read(house + BY_LENGTH + window)
        self.assertAlmostEqual(one.whole.volume, other.whole.volume)
        for kind in ("surfaces", "windows"):
            mine, theirs = (sorted((p.construction, p.boundary, p.azimuth or -1, p.tilt or -1, round(p.area, 6))
                                   for p in getattr(found.whole.shell, kind).values()) for found in (one, other))
            self.assertEqual(mine, theirs)
        self.assertEqual(one.left_out, other.left_out)
        clockwise = self.read((house + BY_LENGTH + window).replace("Counterclockwise", "Clockwise"))
        self.assertEqual(other.whole.shell.surfaces, clockwise.whole.shell.surfaces)
        older = house.replace("25.2", "9.5") + BY_LENGTH.replace("Room, ,", "Room,") + window
        self.assertEqual(other.whole.shell.surfaces, self.read(older).whole.shell.surfaces)

    def test_a_slanted_rectangle(self):
        roof = idf.Object("x", "Roof", {"azimuth_angle": "180", "tilt_angle": "30", "length": "10", "width": "8",
                                        "starting_z_coordinate": "3"})
        points = idf_geometry.rectangle_of(roof)
        normal = idf_geometry.vector_of(points) / 80
        self.assertTrue(np.allclose(normal, [0, -0.5, np.sqrt(3) / 2]), normal)
        self.assertTrue(np.allclose(points[2], [10, 8 * np.sqrt(3) / 2, 3 + 4]), points)

    def test_a_ground_of_its_own_construction(self):
        made = BY_LENGTH.replace("floor, Slab", "floor, Ground") + \
            "Construction:FfactorGroundFloor, Ground, 0.5, 80, 36;\n"
        house = "".join(line + "\n" for line in HOUSE.splitlines() if not line.startswith("Fenestration"))
        shell = self.read(house + made).whole.shell
        (floor,) = (p for p in shell.surfaces.values() if "ground floor" in p.construction)
        self.assertEqual((floor.boundary, floor.area), ("outdoors", ALIKE * LENGTH * DEPTH))
        months = "Site:GroundTemperature:FCfactorMethod, 3, 2, 1, 2, 4, 8, 12, 15, 14, 12, 8;\n"
        shell = self.read(house + made + months).whole.shell
        (floor,) = (p for p in shell.surfaces.values() if "ground floor" in p.construction)
        self.assertEqual(list(shell.grounds[floor.boundary]), [3, 2, 1, 2, 4, 8, 12, 15, 14, 12, 8, 13])

    def test_fans_that_cycle_bring_less_air(self):
        """A unit with a schedule of 0, or none, by its zone or in the zone's list of equipment."""
        usual_flow = self.read(BOX).whole.ventilation.max()
        unit = "AirLoopHVAC:UnitaryHeatCool, Unit, , In, Out, {}, , , , , Room;\n"
        terminal = "ZoneHVAC:PackagedTerminalAirConditioner, Unit, , In, Out, , , 1, 1, 1, , 1, 1, 1, Fan:OnOff, " \
                   "Fan, Coil:Heating:Fuel, Burner, Coil:Cooling:DX:SingleSpeed, Cooler, BlowThrough, {};\n" \
                   "ZoneHVAC:EquipmentConnections, Room, List;\nZoneHVAC:EquipmentList, List, SequentialLoad, " \
                   "ZoneHVAC:PackagedTerminalAirConditioner, Unit, 1, 1, , {};\n"
        always = "Schedule:Constant, Never, , 0;\nSchedule:Constant, Ever, , 1;\n"
        for text, share in ((unit.format("Never"), 0.2), (unit.format(""), 0.2), (unit.format("Ever"), 1),
                            (terminal.format("Never", ""), 0.2), (terminal.format("Ever", ""), 1),
                            (terminal.format("", ", ZoneHVAC:EnergyRecoveryVentilator, Recovery, 2, 2"), 1)):
            with self.subTest(text=text):
                found = self.read(BOX + always + text)
                self.assertAlmostEqual(found.whole.ventilation.max(), share * usual_flow)
                self.assertEqual(share < 1, any("cycle with their coils" in line for line in found.left_out))

    def test_economizers_are_told(self):
        controller = "Controller:OutdoorAir, {}, Out, Back, Mixed, In, 0, 1, {};\n"
        found = self.read(BOX + controller.format("A", "DifferentialDryBulb") + controller.format("B", "NoEconomizer"))
        (told,) = (line for line in found.left_out if "economizer" in line)
        self.assertIn("economizers of 1 of 2 Controller:OutdoorAir", told)
        self.assertNotIn("economizer", "".join(self.read(BOX + controller.format("A", "")).left_out))

    def test_what_fans_draw(self):
        """Power = flow x pressure / efficiency, at the hours of the fan; 4.5 l/(s m2) where the file has no flow. What
        the motor loses outside of the air does not warm it; one that cycles with its coil runs a fifth of the time."""
        fan = "Fan:ConstantVolume, Fan, {}, 0.5, 600, {}, 0.8, 0.5;\n"
        unit = "AirLoopHVAC:UnitaryHeatCool, Unit, , In, Out, {}, , , , , Room, Fan:ConstantVolume, Fan;\n"
        times = "Schedule:Constant, Never, , 0;\nSchedule:Constant, Ever, , 1;\n"
        by_flow, usual_flow = 2 * 600 / 0.5 / (LENGTH * DEPTH * ALIKE), 0.0045 * 600 / 0.5
        for text, power in ((fan.format("", 2), by_flow), (fan.format("", "autosize"), usual_flow),
                            (fan.format("", 2) + unit.format("Never"), 0.2 * by_flow),
                            (fan.format("", 2) + unit.format("Ever"), by_flow)):
            with self.subTest(text=text):
                fans = self.read(BOX + times + text).whole.loads["fans"]
                self.assertAlmostEqual(fans.values.max(), power)
                self.assertAlmostEqual(fans.share, 0.9)
        mornings = "Schedule:Compact, Half, , Through: 12/31, For: AllDays, Until: 12:00, 1, Until: 24:00, 0;\n"
        for available, told in (("", True), ("Half", False)):     # cycles only where it does not run
            found = self.read(BOX + mornings + fan.format(available, 2) + unit.format("Half"))
            hours = found.whole.loads["fans"].values / by_flow
            self.assertTrue(np.allclose(hours[..., :12], 1))
            self.assertTrue(np.allclose(hours[..., 12:], 0.2 if told else 0))
            self.assertEqual(told, "cycle with their coils" in "".join(found.left_out))
        of_hours = self.read(BOX + fan.format("Work", 2)).whole
        self.assertTrue(np.array_equal(of_hours.loads["fans"].values > 0, of_hours.loads["lights"].values > 0))
        system = "Fan:SystemModel, Fan, , In, Out, 2, Discrete, 0, 600, 0.8, 0.5, , , , , 0.5;\n"
        self.assertAlmostEqual(self.read(BOX + system).whole.loads["fans"].values.max(), by_flow)
        self.assertNotIn("fans", self.read(BOX).whole.loads)
        self.assertIn("fans", "".join(self.read(BOX + "Fan:VariableVolume, Fan;\n").left_out))

    def test_machines_whose_heat_and_cold_are_metered_draw_from_the_meter_that_is_there(self):
        """Else the loads have to stand for the electricity of cooling. Ideal loads have no machine."""
        def plant(text, *quantities):
            there = [types.SimpleNamespace(quantity=quantity) for quantity in quantities]
            by_meters = building.Plant("none", 1, 0, (1, 1), "its heat is metered")
            return idf_plant.plant_of(self.read(text), by_meters, there, None)
        found = plant(BOX, "heating", "cooling", "gas", "electricity")
        self.assertEqual((found.heating, found.efficiency), ("gas", 0.82))
        self.assertEqual((found.cooling, found.cop), ("electricity", 3.4))
        found = plant(BOX, "heating", "cooling")
        self.assertEqual((found.heating, found.cooling), ("none", "none"))
        no_machine = "".join(line + "\n" for line in BOX.splitlines() if not line.startswith("Coil"))
        ideal = no_machine + "ZoneHVAC:IdealLoadsAirSystem, Ideal;\n"
        self.assertEqual(plant(ideal, "cooling", "electricity").cooling, "none")

    def plant_in(self, text, *quantities):
        """(Plant, lines to be checked) of a file, beside a boiler by the meters."""
        there = [types.SimpleNamespace(quantity=quantity) for quantity in quantities or ("gas", "electricity")]
        told = Told()
        by_meters = building.Plant("gas", 0.85, 0.06, (0.6, 0.98), "a boiler, for there is a gas meter")
        return idf_plant.plant_of(self.read(text), by_meters, there, told), "\n".join(told.checks)

    def test_machines_are_read_or_told_and_never_taken_as_absent(self):
        no_cooler = without(BOX, "Coil:Cooling")
        self.assertEqual(self.plant_in(no_cooler)[0].cooling_says, "no cooling in the file")
        self.assertLessEqual({"Coil:Cooling:DX:MultiSpeed", "Coil:Cooling:DX:VariableSpeed", "Chiller:Electric",
                              "Coil:Cooling:WaterToAirHeatPump:EquationFit", "HeatPump:PlantLoop:EIR:Cooling",
                              "Coil:Cooling:DX:VariableRefrigerantFlow", "Chiller:Absorption"},
                             {row[0] for row in idf_plant.COOLERS})
        electric = [kind for kind, _, _, carrier in idf_plant.COOLERS if carrier != "none"]
        strange = ["Coil:Cooling:DX:New", "Chiller:New", "CentralHeatPumpSystem", "EvaporativeCooler:Direct:CelDekPad",
                   "HeatPump:AirToWater", "Coil:UserDefined", "Coil:Cooling:Water"]
        for kind in (*electric, *strange):
            with self.subTest(kind=kind):
                plant, said = self.plant_in(f"{no_cooler}{kind}, Machine;\n")
                self.assertEqual((plant.cooling, plant.cop), ("electricity", 3))
                of_cold = "\n".join(line for line in said.splitlines() if "heats by" not in line)
                self.assertEqual(kind in of_cold, kind in strange or idf_plant.is_guessed((kind,), idf_plant.COOLERS))
        for kind in ("Chiller:Absorption", "Chiller:EngineDriven"):
            plant, said = self.plant_in(f"{no_cooler}{kind}, Machine;\n")
            self.assertEqual(plant.cooling, "none")
            self.assertIn(f"cools by {kind}, whose heat or fuel", said)
        _, said = self.plant_in(BOX + "Chiller:New, Machine;\n")
        self.assertIn("cools by Chiller:New, too", said)
        _, said = self.plant_in(no_cooler + "Coil:Cooling:DX:CurveFit:Speed, A; Coil:WaterHeating:New, B;\n")
        self.assertEqual(said, "")

    def test_what_heats_is_read_or_told(self):
        no_heater = without(BOX, "Coil:Heating")
        rows = {row[0] for row in idf_plant.HEATERS}
        self.assertLessEqual({"Coil:Heating:DX:MultiSpeed", "Coil:Heating:DX:VariableSpeed", "Boiler:Steam",
                              "HeatPump:PlantLoop:EIR:Heating", "Coil:Heating:Gas:MultiStage",
                              "Coil:Heating:WaterToAirHeatPump:EquationFit", "Coil:Heating:DX:VariableRefrigerantFlow",
                              "ZoneHVAC:Baseboard:RadiantConvective:Electric",
                              "ZoneHVAC:LowTemperatureRadiant:Electric"}, rows)
        for kind, _, usual, carrier in idf_plant.HEATERS:
            with self.subTest(kind=kind):
                plant, said = self.plant_in(f"{no_heater}{kind}, Machine;\n")
                self.assertEqual(plant.heating_says, f"{kind} of the file")
                self.assertEqual(plant.efficiency, usual)
                burns = {"Coil:Heating:Fuel": "gas", "Coil:Heating:DX:MultiSpeed": "electricity"}.get(kind, "none")
                self.assertEqual(plant.heating, carrier or burns)
        for kind in ("Coil:Heating:DX:New", "Coil:Heating:Water", "Boiler:New", "ZoneHVAC:Baseboard:New",
                     "HeatPump:AirToWater", "ChillerHeater:Absorption:DirectFired"):
            plant, said = self.plant_in(f"{no_heater}{kind}, Machine;\n")
            self.assertEqual(plant.efficiency, 0.85)
            self.assertIn(f"heats by {kind}", said)
        self.assertEqual(self.plant_in(no_heater)[1], "")

    def test_fuels_of_ideal_loads_are_read(self):
        """Since 24.2. District heat and cold at 1, said or not, are left to the plant by the meters."""
        times = "Schedule:Constant, One, , 1; Schedule:Constant, Good, , 0.9; Schedule:Constant, Cold, , 4;\n"
        text = f"{without(BOX, 'Coil:')}{times}ZoneHVAC:IdealLoadsAirSystem, Air{', ' * 28}"
        plant, said = self.plant_in(f"{text}Good, NaturalGas, Cold, Electricity;\n")
        self.assertEqual((plant.heating, plant.efficiency, plant.cooling, plant.cop), ("gas", 0.9, "electricity", 4))
        self.assertEqual(said, "")
        for fuels in ("", "One, DistrictHeatingWater, One, DistrictCooling"):
            plant, _ = self.plant_in(f"{text}{fuels};\n")
            self.assertEqual((plant.efficiency, plant.cooling_says), (0.85, "ideal loads; taken as electric"))
        plant, _ = self.plant_in(f"{text}Good;\n", "gas", "district")
        self.assertEqual((plant.heating, plant.efficiency), ("district", 0.9))
        plant, said = self.plant_in(f"{text}, , Cold, NaturalGas;\n")
        self.assertEqual(plant.cooling, "none")
        self.assertIn("cools by ZoneHVAC:IdealLoadsAirSystem, whose heat or fuel", said)
        found = self.read(f"{text}Work, NaturalGas;\n")
        self.assertIn("Work changes over the year; its mean", "".join(found.checks))
        with self.assertRaisesRegex(Refused, "'Activity' is 120 in the mean; expected a number from 0.01 to 20"):
            self.read(f"{text}Activity, NaturalGas;\n")
        older = f"{text}Good, NaturalGas, Cold, Electricity;\n".replace("25.2", "24.1")
        self.assertEqual(self.read(older).heaters, [])

    def test_efficiencies_stand_at_their_place(self):
        """Fields that versions brought push a COP back."""
        no_coil = without(BOX, "Coil:")
        gaps = ", " * 15
        for text, version, cop in (
                (f"Coil:Cooling:DX:MultiSpeed, C, {gaps}, Electricity, 2, 5000, 0.8, 3.7;\n", "25.2", 3.7),
                (f"Coil:Cooling:DX:MultiSpeed, C, {gaps} Electricity, 2, 5000, 0.8, 3.7;\n", "23.1", 3.7),
                ("Coil:Cooling:WaterToAirHeatPump:EquationFit, C, , , , , , 1, 1, 5000, 4000, 4.2;\n", "25.2", 4.2),
                ("Coil:Cooling:WaterToAirHeatPump:EquationFit, C, , , , , 1, 1, 5000, 4000, 4.2;\n", "25.1", 4.2),
                ("Coil:Cooling:DX:TwoSpeed, C, , 5000, 0.8, 3.2;\n", "25.2", 3.2),
                ("AirConditioner:VariableRefrigerantFlow, C, , 5000, 3.3;\n", "25.2", 3.3),
                (f"HeatPump:PlantLoop:EIR:Cooling, C{', ' * 12} 5000, 3.9;\n", "25.2", 3.9),
                (f"HeatPump:PlantLoop:EIR:Cooling, C{', ' * 9} 5000, 3.9;\n", "24.1", 3.9),
                ("Chiller:Electric, C, AirCooled, 5000, 2.8;\n", "25.2", 2.8)):
            with self.subTest(text=text, version=version):
                self.assertEqual(self.plant_in((no_coil + text).replace("25.2", version))[0].cop, cop)

    def test_classes_of_energyplus_that_heat_or_cool_are_known(self):
        program = energyplus.program()
        if program is None:
            self.skipTest(energyplus.HOW)
        rows = {row[0] for row in (*idf_plant.HEATERS, *idf_plant.COOLERS)}
        there = set(energyplus.Schema(program).classes)
        self.assertEqual(rows - there, {"Coil:Heating:Gas", "DistrictHeating"})
        self.assertEqual([kind for kind in rows if not idf_plant.modes_of(kind.lower())], [])
        unread = {kind for kind in there - rows if kind.startswith(("Coil:", "Chiller", "Boiler", "HeatPump"))
                  and not idf_plant.modes_of(kind.lower())}
        self.assertEqual({kind for kind in unread if not idf_plant.is_of(kind.lower(), idf_plant.PARTS)}, set())

    def test_ventilation_that_a_limit_keeps_off_is_told(self):
        """Its constant coefficient counts; what temperature or wind alone drive is no flow of all hours."""
        before = self.read(BOX).whole.ventilation.mean()
        text = "ZoneVentilation:DesignFlowRate, Fan, Room, , AirChanges/Hour, , , , 2, Exhaust, 30, 0.5, {};\n"
        limits = "minimum_indoor_temperature", "delta_temperature", "maximum_outdoor_temperature"
        for fields, added, says in (
                ("", 2, ""), ("0.5, 0, 0, 0", 1, ""), ("1, 0, 0, 0, 15, , 100, , -100", 2, ""),
                ("1, 0, 0, 0, 29.4", 0, limits[0]), ("1, 0, 0, 0, -100, Frost", 0, limits[0]),
                ("1, 0, 0, 0, , , , , 12", 0, limits[1]), (f"1, 0, 0, 0{', ' * 9} 15", 0, limits[2]),
                (f"1, 0, 0, 0{', ' * 11} 2", 0, "maximum_wind_speed"),
                ("0, 0, 0.224", 0, "velocity_term_coefficient, without a constant part"),
                ("0.6, 0.04", 1.2, "temperature_term_coefficient of")):
            with self.subTest(fields=fields):
                found = self.read(BOX + "Schedule:Constant, Frost, , 25;\n" + text.format(fields))
                self.assertAlmostEqual(found.whole.ventilation.mean() - before, added)
                said = [line for line in found.left_out if 'ZoneVentilation:DesignFlowRate "Fan"' in line]
                self.assertEqual(len(said), bool(says), said)
                self.assertTrue(all(says in line for line in said), said)

    def test_a_heat_recovery_unit_ventilates_its_zone(self):
        """In place of the zone's own outdoor air; by area and people where EnergyPlus finds its flow."""
        text = "ZoneHVAC:EquipmentConnections, Room, List;\nZoneHVAC:EquipmentList, List, SequentialLoad, " \
               "ZoneHVAC:EnergyRecoveryVentilator, Unit, 1, 1;\nSchedule:Constant, Half, , 0.5;\n" \
               "HeatExchanger:AirToAir:{}, Wheel, , 0.02, 0.7;\n" \
               "ZoneHVAC:EnergyRecoveryVentilator, Unit, Half, Wheel, {};\n"
        volume, of_area = LENGTH * DEPTH * HEIGHT, 0.000508 * LENGTH * DEPTH + 0.00236 * LENGTH * DEPTH / 10
        for flow, expected in (("0.02", 0.02), ("autosize", of_area)):
            found = self.read(BOX + text.format("SensibleAndLatent", flow))
            self.assertAlmostEqual(found.whole.ventilation.mean(), 0.5 * 3600 * expected / volume)
            self.assertAlmostEqual(found.whole.heat_recovery, 0.7)
            self.assertNotIn("recovery", "".join(found.left_out))
        plates = self.read(BOX + text.format("FlatPlate", "0.02"))
        self.assertEqual(plates.whole.heat_recovery, 0)
        self.assertIn('heat recovery of ZoneHVAC:EnergyRecoveryVentilator "Unit"', "".join(plates.left_out))
        fan = "ZoneVentilation:DesignFlowRate, Fan, Room, , Flow/Zone, 0.01;\n"
        both = self.read(BOX + fan + text.format("SensibleAndLatent", "0.02"))
        self.assertAlmostEqual(both.whole.heat_recovery, 0.7 / 2)
        lost = self.read(BOX + text.format("SensibleAndLatent", "0.02").replace("List, Seq", "Other, Seq"))
        self.assertIn("stands in no zone's", "".join(lost.left_out))
        loose = self.read(BOX + "HeatExchanger:AirToAir:SensibleAndLatent, Wheel, , 0.02, 0.7;\n")
        self.assertIn("write heat_recovery in the flow", "".join(loose.left_out))

    def test_a_surface_before_a_zone_is_one_of_that_zone_too(self):
        """The store without its own wall to the room: areas, volumes and masses are those of a file that has both."""
        two = TWO.replace("Wall, Brick, Wool, Brick;", "Wall, Wool, Brick;\nConstruction, Back, Brick, Wool;").replace(
            "store east, Wall, Wall,", "store east, Wall, Back,")
        one_sided = without(two, "BuildingSurface:Detailed, store east").replace(
            "Room, , Surface, store east,", "Room, , Zone, Store,")
        path = self.folder / "sides.idf"
        for text in (one_sided, one_sided.replace("Room, , Zone, Store,", "Room, , Space, Corner,") +
                     "Space, Corner, Store;\n"):
            path.write_text(text)
            found = idf_building.read_building(str(path), has_rooms=True)
            (self.folder / "both.idf").write_text(two)
            known = idf_building.read_building(str(self.folder / "both.idf"), has_rooms=True)
            for one, other in zip(found.rooms, known.rooms):
                self.assertAlmostEqual(one.volume, other.volume)
                self.assertAlmostEqual(one.area, other.area)
                self.assertAlmostEqual(one.shell.heat_capacity, other.shell.heat_capacity)
                self.assertEqual(one.shell.between.keys(), other.shell.between.keys())

    def test_a_floor_seen_from_below_and_from_elsewhere(self):
        """The floor of a room is the ceiling of the cellar that it names, and a ceiling the floor of what is above; in
        the axes of that zone."""
        ceiling = BOX.replace("roof, Roof, Roof, Room, , Outdoors, ,", "roof, Ceiling, Roof, Room, , Zone, Loft,")
        loft = "Zone, Loft, 40, 7, -3, 2;\nBuildingSurface:Detailed, loft roof, Roof, Roof, Loft, , Outdoors, , " \
               ", , , 3, 0,0,4, 1,0,4, 0,1,4;\n"
        (self.folder / "box.idf").write_text(ceiling + loft)
        zones = idf_geometry.read_zones(idf.read_model(str(self.folder / "box.idf")))
        (roof,) = (s for s in zones["room"].surfaces if s.given.name == "roof")
        _, floor = zones["loft"].surfaces
        self.assertEqual((floor.kind, floor.tilt, zones["loft"].area), ("floor", 180, LENGTH * DEPTH))
        for s, north, corner in ((roof, (0, NORTH), (5, 5, 0)), (floor, (40, NORTH), (7, -3, 2))):
            inner, outer = (idf_geometry.rotation(turn) for turn in north)
            points = (s.points @ inner + np.array(corner)) @ outer
            s.points = points
        self.assertTrue(np.allclose(floor.points[::-1], roof.points), (floor.points, roof.points))
        wall = BOX.replace("north, Wall, Wall, Room, , Outdoors, ,", "north, Wall, Wall, Room, , Zone, Loft,")
        loft = idf_geometry.read_zones(idf.read_model(str(self.box_of(wall + loft))))["loft"]
        self.assertAlmostEqual(loft.surfaces[1].azimuth, NORTH + 180)

    def test_a_mirrored_surface_has_its_first_layer_inside(self):
        model = idf.Model("x", [idf.Object("x", "Material", {
            "name": name, "thickness": "0.1", "conductivity": conductivity, "density": density,
            "specific_heat": "1000"})
            for name, conductivity, density in (("Heavy", "2", "2000"), ("Foam", "0.03", "20"))] + [
                idf.Object("x", "Construction", {"name": "Wall", "outside_layer": "Heavy", "layer_2": "Foam"})])
        wall = idf.Object("x", "Wall", {"construction_name": "Wall"})
        self.assertEqual(idf_envelope.mass_of(model, wall), 0)
        self.assertAlmostEqual(idf_envelope.mass_of(model, wall, is_mirrored=True), 0.1 * 2000 * 1000)

    def test_heat_of_lights_in_the_return_air_does_not_reach_the_room(self):
        lights = self.read(BOX.replace("Watts/Area, , 8;", "Watts/Area, , 8, , 0.4, 0.2;")).whole.loads["lights"]
        self.assertAlmostEqual(lights.share, 0.6)

    def test_encodings(self):
        for encoding in ("utf-8-sig", "utf-16"):
            path = self.folder / "box.idf"
            path.write_bytes(BOX.encode(encoding))
            self.assertAlmostEqual(idf_building.read_building(str(path)).whole.area, ALIKE * LENGTH * DEPTH)
        for name, given, word in (("box.idf", BOX.encode("utf-16-le"), "UTF-16"), ("box.epJSON", b"\xef\xbb\xbf{}",
                                                                                 "byte order mark")):
            path = self.folder / name
            path.write_bytes(given)
            with self.assertRaisesRegex(Refused, word):
                idf_building.read_building(str(path))
        with self.assertRaisesRegex(Refused, "'##include wall.inc' is a line of EP-Macro; run"):
            self.read("! comment\n  ##include wall.inc\n" + BOX)

    def test_letters_of_windows(self):
        """Names of zones that differ by such a letter alone stay apart; epJSON has to be UTF-8."""
        text = TWO.replace("Store", "B\u00fcro").replace("Room", "B\u00f6ro")
        for encoding, is_told in (("utf-8", False), ("cp1252", True)):
            path = self.folder / "box.idf"
            path.write_bytes(text.encode(encoding))
            found = idf_building.read_building(str(path), has_rooms=True)
            self.assertEqual([room.name for room in found.rooms], ["B\u00f6ro", "B\u00fcro"])
            self.assertEqual([line for line in found.checks if "is not UTF-8; it was read as Windows-1252" in line],
                             found.checks)
            self.assertEqual(len(found.checks), is_told)
        path = self.folder / "box.epJSON"
        path.write_bytes("{\"B\u00fcro\": 1}".encode("cp1252"))
        with self.assertRaisesRegex(Refused, "box.epJSON: is not UTF-8; save it as UTF-8"):
            idf_building.read_building(str(path))

    def test_soil_of_a_green_roof_is_a_layer(self):
        soil = "Material:RoofVegetation, Soil, , , , , , , , 0.2, 0.4, 1000, 1500, 0.9, 0.6;\n"
        shell = self.read(BOX.replace("Construction, Roof, Wool,", "Construction, Roof, Soil,") + soil).whole.shell
        self.assertAlmostEqual(shell.opaque["Roof"].u_value, 1 / (OUTSIDE + 0.2 / 0.4 + 0.1 + UP), 4)
        self.assertAlmostEqual(shell.opaque["Roof"].absorptance, 0.6)
        text = BOX.replace("Construction, Roof, Wool, Concrete;", "Construction, Roof, Soil;")
        model = idf.read_model(str(self.box_of(text + soil)))
        roof = idf.Object("x", "Roof", {"construction_name": "Roof"})
        self.assertAlmostEqual(idf_envelope.mass_of(model, roof), 0.1 * 1000 * 1500)
        of_energyplus = self.read(text + "Material:RoofVegetation, Soil;\n").whole.shell.opaque["Roof"]
        self.assertAlmostEqual(of_energyplus.u_value, 1 / (OUTSIDE + 0.1 / 0.35 + UP), 4)

    def box_of(self, text):
        path = self.folder / "box.idf"
        path.write_text(text)
        return path

    def test_dates_with_names_of_months_and_years_that_begin_in_autumn(self):
        known = self.read(BOX).whole
        for date in ("30 Jun", "June 30", "30 june", "06/30"):
            lights = self.read(BOX.replace("Through: 6/30", f"Through: {date}")).whole.loads["lights"].values
            self.assertTrue((lights == known.loads["lights"].values).all(), date)
        with self.assertRaisesRegex(Refused, "'30 Juin' is no date"):
            self.read(BOX.replace("Through: 6/30", "Through: 30 Juin"))
        warm = BOX.replace("Schedule:Year, Heat, , Week, 1, 1, 12, 31;",
                           "Schedule:Week:Daily, Summer, Off, Off, Off, Off, Off, Off, Off, Off, Off, Off, Off, Off;\n"
                           "Schedule:Year, Heat, , Week, 10, 1, 4, 30, Summer, 5, 1, 9, 30;")
        heating = self.read(warm).whole.heating[:, 0, 12]
        self.assertEqual([list(heating).count(value) for value in (21, 16)], [212, 153])
        self.assertEqual(list(heating[[0, 119, 120, 272, 273, 364]]), [21, 21, 16, 16, 21, 21])
        self.assertEqual(list(idf_schedules.days_between(363, 1)), [363, 364, 0, 1])

    def test_fields_that_cannot_be_and_names_that_are_there_twice(self):
        self.refused("0.24, 0.8, 1800", "0,24, 0,8, 1800", 'Material "Brick": has 11 fields', "9 at most", "10.76")
        self.refused("Cool, , 26;", "Cool, , 26,5;", 'Schedule:Constant "Cool": has 4 fields')
        self.assertEqual(self.read(BOX.replace("Cool, , 26;", "Cool, , 26, , ;")).whole.cooling.mean(), 26)
        self.refused("Zone, Room,", "Zone, room;\nZone, Room,", 'Zone "Room": name', "defined twice")
        self.refused(", north, Wall", ", south, Wall", 'BuildingSurface:Detailed "south": name', "defined twice")

    def test_people_in_rooms_between_the_set_points(self):
        """Half-way, and where cooling is set far up 3 K above heating; sensible of 120 W are 71.9 W at 23.5 degC."""
        text = BOX.replace("0.3, 0.5, Activity", "0.3, , Activity")
        people = LENGTH * DEPTH / 10 * ALIKE
        for cooling, room in ((26, 23.5), (40, 24)):
            found = self.read(text.replace("Cool, , 26", f"Cool, , {cooling}"))
            self.assertAlmostEqual(found.whole.loads["people"].values[0, 0, 12] * found.whole.area,
                                   people * idf_use.sensible(120, room))
        self.assertAlmostEqual(float(idf_use.sensible(120, 23.5)), 71.9, delta=0.1)

    def test_people_in_rooms_that_the_weather_warms_and_cools(self):
        """At steady weather: at heating's set-point, at cooling's, and where the balance ends between them."""
        shell = idf_envelope.Shell({"Wall": idf_envelope.Opaque("Wall", 0.5, 0.5, 0.7, 0.9, 0.04)})
        shell.surfaces["wall"] = idf_envelope.Part("Wall", 0, 90, area=100)
        shell.grounds = {"ground": np.full(12, 10.0)}
        none = idf_schedules.constant(0)
        room = idf_room.Balance(shell, 1e6, none, none + 100, (none + 20, none + 26))
        for theta, sun, expected in ((0, 0, 20), (30, 0, 26), (21, 0, 23),
                                     (21, 50, 23 + 0.7 * 0.04 * (50 / 2 + 0.2 * 50 / 2))):
            hours = [(dt.datetime(2021, 1, 1) + dt.timedelta(hours=k), theta, sun, 0, sun) for k in range(8760)]
            found = room.temperatures(hours)
            self.assertTrue(np.allclose(found, expected, atol=0.02), (theta, found))
        hours = [(time, 30 if time.weekday() < 5 else 0, 0, 0, 0) for time, *_ in hours]
        found = room.temperatures(hours)
        self.assertTrue((found[:5, 12:] == 26).all() and (found[[5, 6, 7], 23] < 21).all())
        # People in the box: 120 W each, of which less is sensible where it is warmer.
        year = [(dt.datetime(2021, 1, 1) + dt.timedelta(hours=k), 60, 0, 0, 0) for k in range(8760)]
        (self.folder / "box.idf").write_text(BOX.replace("0.3, 0.5, Activity", "0.3, , Activity"))
        cold, warm = (idf_building.read_building(str(self.folder / "box.idf"), hours=hours).whole.loads["people"].values
                      for hours in ((), year))
        at = 0, 0, 12
        self.assertAlmostEqual(warm[at] / cold[at], float(idf_use.sensible(120, 26) / idf_use.sensible(120, 23.5)), 3)

    def test_u_values_have_films(self):
        shell = self.read(BOX).whole.shell
        brick = 0.24 / 0.8
        self.assertAlmostEqual(shell.opaque["Wall"].u_value, 1 / (OUTSIDE + 2 * brick + 2.5 + INSIDE), 5)
        self.assertAlmostEqual(shell.opaque["Roof"].u_value, 1 / (OUTSIDE + 2.5 + 0.1 + UP), 5)
        self.assertAlmostEqual(shell.opaque["Slab"].u_value, 1 / (0.1 + DOWN), 4)
        self.assertAlmostEqual(shell.opaque["Wall"].absorptance, 0.65)
        glazing = shell.glazing["Window"]
        self.assertEqual((glazing.u_value, glazing.solar), (1.8, 0.45))

    def test_panes_and_gaps(self):
        """Clear glass, 4 mm, 12 mm of air between: 2.9 W/(m2 K) and 0.78 by EN 673 and EN 410; one pane 5.8."""
        panes = "WindowMaterial:Glazing, Clear, SpectralAverage, , 0.004, 0.82, 0.075, 0.075, 0.89, 0.08, 0.08, 0, " \
                "0.84, 0.84, 1;\nWindowMaterial:Gas, Gap, Air, 0.012;\n"
        double = BOX.replace("Window, Pane;", "Window, Clear, Gap, Clear;") + panes
        glazing = self.read(double).whole.shell.glazing["Window"]
        self.assertAlmostEqual(glazing.u_value, 2.86, delta=0.06)
        self.assertAlmostEqual(glazing.solar, 0.76, delta=0.02)
        single = self.read(BOX.replace("Window, Pane;", "Window, Clear;") + panes).whole.shell.glazing["Window"]
        self.assertAlmostEqual(single.u_value, 5.75, delta=0.1)

    def test_light_is_kept_in_panes(self):
        model = idf.Model("x", [])
        panes = [idf.Object("x", "WindowMaterial:Glazing", {
            "solar_transmittance_at_normal_incidence": t, "front_side_solar_reflectance_at_normal_incidence": r,
            "back_side_solar_reflectance_at_normal_incidence": r}) for t, r in (("0.7", "0.1"), ("0.6", "0.2"))]
        transmitted, absorbed = idf_envelope.solar_of(panes)
        self.assertAlmostEqual(transmitted, 0.7 * 0.6 / (1 - 0.1 * 0.2))
        reflected = 0.1 + 0.7**2 * 0.2 / (1 - 0.1 * 0.2)
        self.assertAlmostEqual(sum(absorbed), 1 - transmitted - reflected)
        self.assertIsNone(model.find("a", "Zone"))

    def test_schedules_by_day_and_season(self):
        profile = self.read(BOX).whole.loads["lights"].values
        density = 8
        spring, autumn = profile[10], profile[300]
        self.assertAlmostEqual(spring[0, 9], density)
        self.assertAlmostEqual(spring[0, 17], density / 2)         # until half past five
        self.assertAlmostEqual(spring[5, 3], density / 4)
        self.assertAlmostEqual(spring[6, 12], 0)
        self.assertAlmostEqual(spring[7, 12], 0)                   # a holiday
        self.assertAlmostEqual(autumn[2, 3], density / 2)
        self.assertEqual([run[:2] for run in idf_schedules.runs_of(profile)], [(0, 180), (181, 364)])

    def of_file(self, rows, said="", more="", house=BOX):
        """The box heated by column 2 of a CSV file, of which `said` are the last fields."""
        (self.folder / "heat.csv").write_text("\n".join(rows) + "\n")
        text = without(house, "Schedule:Year, Heat") + f"Schedule:File, Heat, , heat.csv, 2, 1{said};\n{more}"
        return self.read(text)

    def hours_by_date(self, year, value, separator=",", per_hour=1):
        """A header, and a row for each item of a year; `value` of day of the year from 0, weekday and hour."""
        days = [dt.date(year, 1, 1) + dt.timedelta(days=k) for k in range(366 if year % 4 == 0 else 365)]
        return ["k,heat"] + [f"{k}{separator} {value(k, day.weekday(), hour)}" for k, day in enumerate(days)
                             for hour in range(24) for _ in range(per_hour)]

    def test_hours_of_a_file(self):
        """As the box has them, but by files of a year; the weekday is the run period's, else as weekends stand out."""
        def office(day, weekday, hour):
            return 21 if weekday < 5 and 6 <= hour < 20 else 16
        known = self.read(BOX).whole.heating
        for year, said, more, separator, per_hour in (
                (2021, "", "", ",", 1), (2022, ", 8760, Semicolon, No, 30", "", ";", 2),
                (2020, ", 8784, Tab", "", "\t", 1), (2023, ", 8760, Space, No, 60", "", " ", 1),
                (2021, "", "RunPeriod, Year, 1, 1, 2021, 12, 31, 2021;\n", ",", 1),
                (2021, "", "RunPeriod, Year, 1, 4, , 12, 31, , Monday;\n", ",", 1)):
            with self.subTest(year=year, said=said):
                found = self.of_file(self.hours_by_date(year, office, separator, per_hour), said, more)
                self.assertTrue((found.whole.heating == known).all())
                self.assertEqual(found.checks, [])
        shifted = self.of_file(self.hours_by_date(2021, office), more="RunPeriod, Year, 1, 1, , 12, 31, , Saturday;\n")
        self.assertEqual([day[12] for day in shifted.whole.heating[100]], [16, 21, 21, 21, 21, 21, 16, 16])
        halves = self.hours_by_date(2021, lambda *_: 10, per_hour=2)
        halves[2::2] = [row.replace(" 10", " 20") for row in halves[2::2]]
        self.assertEqual(set(self.of_file(halves, ", 8760, Comma, No, 30").whole.heating.flat), {15})

    def test_files_with_seasons_and_without_weeks(self):
        """26 parts of a year are kept; of more the mean week of each month."""
        found = self.of_file(self.hours_by_date(2021, lambda day, weekday, hour: 21 if 84 <= day < 280 else 16))
        changes = [first for first, _, _ in idf_schedules.runs_of(found.whole.heating)]
        self.assertEqual((len(changes), found.whole.heating[83].max(), found.whole.heating[90].min()), (5, 21, 21))
        for n_parts, is_kept in ((26, True), (27, False)):
            found = self.of_file(self.hours_by_date(2018, lambda day, *_: min(day // 7, n_parts - 1)),
                                 more="RunPeriod, Year, 1, 1, 2018, 12, 31;\n")     # from a Monday
            self.assertEqual(len(idf_schedules.runs_of(found.whole.heating)), n_parts if is_kept else 8)
            self.assertEqual(found.checks, [] if is_kept else [
                'Schedule:File "Heat": its weeks change 26 times a year; the mean week of each month was taken'])
        january = found.whole.heating[:31]
        self.assertTrue((january == january[0]).all())
        self.assertAlmostEqual(january[0, 0, 0], np.mean([k // 7 for k in range(31)]))

    def test_files_that_are_not_there(self):
        """A set-point is the use's, what a person gives usual, and a share 1; each is told."""
        text = without(BOX, "Schedule:Year, Heat", "Schedule:Constant, A", "Schedule:Constant, C") + "".join(
            f"Schedule:File, {name}, , {name}.csv, 1, 0;\n" for name in ("Heat", "Cool", "Activity", "Shut"))
        path = self.box_of(text.replace("Lights, Room, Work", "Lights, Room, Shut").replace("Control, Room, Activity",
                                                                                            "Control, Room, Shut"))
        found = idf_building.read_building(str(path), set_points=(19, 24))
        self.assertEqual((found.whole.heating.mean(), found.whole.cooling.mean()), (19, 24))
        self.assertEqual(found.whole.loads["lights"].values.mean(), 8)
        self.assertAlmostEqual(found.whole.loads["people"].values.max(), 120 * 0.5 / 10)
        said = "\n".join(found.checks)
        for words in ('Cool.csv, which Schedule:File "Cool" reads, is no file; 24, usual of the use, was taken',
                      "Heat.csv", "19, usual", "Activity.csv", "is no file; 120 was taken", "is no file; 1 was taken"):
            self.assertIn(words, said)

    def test_files_that_cannot_be_read(self):
        rows = self.hours_by_date(2021, lambda *_: 20)
        for changed, said, words in ((rows[:-1], "", "heat.csv has 8759 rows of numbers; expected 8760"),
                                     ([*rows[:9], "9, warm", *rows[10:]], "", "'warm'; expected a number"),
                                     ([*rows[:9], "9, nan", *rows[10:]], "", "no finite number"),
                                     ([*rows[:9], "9", *rows[10:]], "", "'9' has no column 2"),
                                     (rows, ", 8760, Comma, No, 7", "7 is no part of an hour")):
            with self.assertRaises(Refused) as caught:
                self.of_file(changed, said)
            self.assertIn('box.idf: Schedule:File "Heat"', str(caught.exception))
            self.assertIn(words, str(caught.exception))

    def test_holidays_that_none_names_are_sundays(self):
        text = BOX.replace("For: AllOtherDays, Until: 24:00, 0,", "For: Sunday, Until: 24:00, 0.1,")
        profile = self.read(text).whole.loads["lights"].values
        self.assertAlmostEqual(profile[10, 7, 12], 0.8)

    def test_words_that_are_no_day_beside_one_that_is(self):
        thing = idf.Object("x", "Schedule:Compact", {})
        self.assertEqual(idf_schedules.kinds_of(thing, "field", "Weedends Sunday", set()), {6})
        self.assertEqual(idf_schedules.kinds_of(thing, "field", "Weedends WinterDesignDay", set()), set())
        with self.assertRaisesRegex(Refused, "'weedends' is no kind of day"):
            idf_schedules.kinds_of(thing, "field", "Weedends", set())

    def test_loads_air_and_set_points(self):
        found = self.read(BOX)
        people = LENGTH * DEPTH / 10
        self.assertAlmostEqual(found.whole.loads["people"].values.max(), people * 120 * 0.5 * ALIKE / found.whole.area)
        self.assertAlmostEqual(found.whole.loads["equipment"].values.max(), 400 * ALIKE / found.whole.area)
        self.assertAlmostEqual(found.whole.loads["equipment"].share, 0.7)
        self.assertAlmostEqual(found.whole.infiltration.mean(), 0.5 * (0.6 + 0.04 * 10))
        fresh = people * 0.005 + LENGTH * DEPTH * 0.0005
        self.assertAlmostEqual(found.whole.ventilation.max(), 3600 * fresh / (LENGTH * DEPTH * HEIGHT))
        heating = found.whole.heating
        self.assertEqual((heating[0, 0, 12], heating[0, 0, 2], heating[0, 6, 12]), (21, 16, 16))
        self.assertEqual(found.whole.cooling.mean(), 26)
        self.assertEqual(found.heaters, [("Coil:Heating:Fuel", "gas", 0.82)])
        self.assertEqual(found.coolers, [("Coil:Cooling:DX:SingleSpeed", "electricity", 3.4)])

    def test_ideal_loads_of_a_template(self):
        text = "".join(line + "\n" for line in BOX.splitlines() if not line.startswith(("ZoneControl", "Coil")))
        found = self.read(text + "HVACTemplate:Thermostat, Stat, , 19, , 27;\n"
                                 "HVACTemplate:Zone:IdealLoadsAirSystem, Room, Stat;\n")
        self.assertEqual((found.whole.heating.mean(), found.whole.cooling.mean(), found.is_ideal), (19, 27, True))
        self.assertEqual(found.whole.ventilation.max(), 0)

    def test_outdoor_air_of_ideal_loads(self):
        text = "".join(line + "\n" for line in BOX.splitlines() if not line.startswith(("ZoneControl", "Coil")))
        stat, gap = "HVACTemplate:Thermostat, Stat, , 19, , 27;\n", ", " * 18
        by_area = self.read(f"{text}{stat}HVACTemplate:Zone:IdealLoadsAirSystem, Room, Stat{gap}, Flow/Area, , "
                            "0.001;\n")
        self.assertAlmostEqual(by_area.whole.ventilation.max(), 3600 * 0.001 / HEIGHT)
        named = self.read(f"{text}{stat}HVACTemplate:Zone:IdealLoadsAirSystem, Room, Stat{gap}, DetailedSpecification, "
                          ", , , Fresh;\n")
        fresh = LENGTH * DEPTH / 10 * 0.005 + LENGTH * DEPTH * 0.0005
        self.assertAlmostEqual(named.whole.ventilation.max(), 3600 * fresh / (LENGTH * DEPTH * HEIGHT))
        system = self.read(BOX + f"ZoneHVAC:IdealLoadsAirSystem, Air, , Supply{', ' * 17}, Fresh;\n"
                           "ZoneHVAC:EquipmentConnections, Room, List, Supply;\n")
        self.assertAlmostEqual(system.whole.ventilation.max(), named.whole.ventilation.max())

    def test_heat_recovery_of_ideal_loads(self):
        """Its sensible part, 0.7 where the field is empty; the rest is told."""
        air = self.read(BOX).whole.ventilation
        for kind, said, share in (("Sensible", 0.75, 0.75), ("Sensible", "", 0.7), ("Enthalpy", 0.6, 0.6),
                                  ("None", 1, 0)):
            found = self.read(ideal(heat_recovery_type=kind, sensible_heat_recovery_effectiveness=said))
            self.assertAlmostEqual(found.whole.heat_recovery, share)
            self.assertTrue(np.allclose(found.whole.ventilation, air))
            self.assertEqual(kind == "Enthalpy", "recovery of latent heat" in "".join(found.left_out))

    def test_outdoor_air_of_ideal_loads_follows_people_and_availability(self):
        """1 in 10 m2, 5 l/s each and 0.5 l/(s m2)."""
        per_volume, people = 3600 / (LENGTH * DEPTH * HEIGHT), LENGTH * DEPTH / 10
        found = self.read(ideal(demand_controlled_ventilation_type="OccupancySchedule"))
        for hour, present in ((12, people), (3, 0)):
            flow = present * 0.005 + LENGTH * DEPTH * 0.0005
            self.assertAlmostEqual(found.whole.ventilation[10, 0, hour], per_volume * flow)
        off = self.read(ideal(availability_schedule_name="Work"))
        self.assertEqual([off.whole.ventilation[10, 0, hour] > 0 for hour in (3, 12)], [False, True])
        by_co2 = self.read(ideal(demand_controlled_ventilation_type="CO2Setpoint",
                                 outdoor_air_economizer_type="DifferentialDryBulb"))
        self.assertAlmostEqual(by_co2.whole.ventilation.max(), self.read(BOX).whole.ventilation.max())
        for word in ("1 ZoneHVAC:IdealLoadsAirSystem: demand_controlled_ventilation_type: outdoor air by CO2",
                     "economizers; venting_air_change"):
            self.assertIn(word, "".join(by_co2.left_out))

    def test_limits_of_ideal_loads(self):
        """Of all zones that are one; a flow's limit, and sizes that EnergyPlus finds, are told."""
        whole = self.read(ideal(heating_limit="LimitCapacity", maximum_sensible_heating_capacity=2400,
                                cooling_limit="LimitFlowRateAndCapacity", maximum_total_cooling_capacity=1600)).whole
        self.assertEqual((whole.heating_capacity, whole.cooling_capacity), (30, 20))
        none = self.read(ideal(maximum_sensible_heating_capacity=2400))
        self.assertIsNone(none.whole.heating_capacity)
        self.assertEqual([line for line in none.left_out if "Ideal" in line or "limit" in line], [])
        for mode, limit, words in (("heating", "LimitFlowRate", "limits of the air flow of heating"),
                                   ("cooling", "LimitCapacity", "cooling capacities that EnergyPlus finds")):
            found = self.read(ideal(**{f"{mode}_limit": limit}))
            self.assertIsNone(getattr(found.whole, f"{mode}_capacity"))
            self.assertIn(words, "".join(found.left_out))
        path = self.box_of(ideal(TWO, heating_limit="LimitCapacity", maximum_sensible_heating_capacity=2400))
        for has_rooms, limits in ((False, [None]), (True, [30, None])):
            found = idf_building.read_building(str(path), has_rooms=has_rooms)
            self.assertEqual([room.heating_capacity for room in found.rooms], limits)
            self.assertEqual(not has_rooms, "limits of heating that some zones have" in "".join(found.left_out))

    def test_ideal_loads_that_are_off(self):
        """What is never on has no capacity; a part of the year is told."""
        plant, _ = self.plant_in(ideal(cooling_availability_schedule_name="Never"))
        self.assertEqual((plant.cooling, plant.cooling_says), (None, "its ideal loads never cool"))
        found = self.read(ideal(heating_availability_schedule_name="Never"))
        self.assertEqual((found.whole.heating_capacity, found.whole.cooling_capacity), (0, None))
        found = self.read(ideal(cooling_availability_schedule_name="Summer"))
        self.assertIsNone(found.whole.cooling_capacity)
        said = [line for line in found.left_out if " is off in " in line]
        self.assertEqual(len(said), 1)
        self.assertIn(f"cooling is off in {1 - 153 / 365:.0%} of the year; cooling_limit", said[0])

    def test_thermostats_whose_control_changes(self):
        """Types 1 and 2 heat or cool, 4 does both; others are no types, and say nothing."""
        one = BOX.replace("Control, Room, Activity,", "Control, Room, Type,") + "Schedule:Constant, Type, , {};\n"
        for kind, heats, cools in ((1, True, False), (2, False, True), (4, True, True), (5, True, True)):
            found = self.read(one.format(kind))
            self.assertEqual((found.whole.heating is not None, found.whole.cooling is not None), (heats, cools), kind)
            self.assertNotIn("control_type_schedule_name", "".join(found.left_out))
        by_season = BOX.replace("Control, Room, Activity,", "Control, Room, Season,") + \
            "Schedule:Compact, Season, , Through: 6/30, For: AllDays, Until: 24:00, 1, Through: 12/31, For: AllDays, " \
            "Until: 24:00, 4;\n"
        said = [line for line in self.read(by_season).left_out if "control_type_schedule_name" in line]
        self.assertEqual(len(said), 1)
        self.assertIn(f"cooling is off in {181 / 365:.0%} of the year", said[0])

    def test_lists_and_spaces(self):
        """Loads of a list of zones, and of a space by its own floor."""
        text = BOX + "ZoneList, All, Room;\nSpace, Corner, Room;\n"
        listed = self.read(text.replace("Lights, Lights, Room", "Lights, Lights, All"))
        self.assertAlmostEqual(listed.whole.loads["lights"].values.max(), 8)
        spaced = self.read(text.replace("Lights, Lights, Room", "Lights, Lights, Corner"))
        self.assertAlmostEqual(spaced.whole.loads["lights"].values.max(), 8)

    def test_methods_of_infiltration(self):
        outer = LENGTH * DEPTH + LENGTH * HEIGHT * 2 + DEPTH * HEIGHT
        walls = outer - LENGTH * DEPTH
        volume = LENGTH * DEPTH * HEIGHT
        for method, flow in (("Flow/Zone, 0.02, , ,", 0.02), ("Flow/Area, , 0.0003, ,", 0.0003 * LENGTH * DEPTH),
                             ("Flow/ExteriorArea, , , 0.0002,", 0.0002 * outer),
                             ("Flow/ExteriorWallArea, , , 0.0002,", 0.0002 * walls)):
            with self.subTest(method=method):
                text = BOX.replace("AirChanges/Hour, , , , 0.5, 0.6, 0.04, 0, 0;", f"{method} ;")
                self.assertAlmostEqual(self.read(text).whole.infiltration.mean(), 3600 * flow / volume)

    def test_a_zone_without_a_thermostat_is_a_factor(self):
        """A loft of 1 m behind the roof: b is its loss to outdoors over all."""
        corners = {"loft roof": ("Roof", "Roof", "Outdoors", "", "0,8,4, 0,0,4, 10,0,4, 10,8,4"),
                   "loft floor": ("Floor", "Roof", "Surface", "roof", "0,0,3, 0,8,3, 10,8,3, 10,0,3")}
        loft = "Zone, Loft, 0, 5, 5, 0, 1, 2;\n" + "".join(
            f"BuildingSurface:Detailed, {name}, {kind}, {of}, Loft, , {outside}, {other}, , , , 4, {points};\n"
            for name, (kind, of, outside, other, points) in corners.items())
        text = BOX.replace("roof, Roof, Roof, Room, , Outdoors, ,", "roof, Roof, Roof, Room, , Surface, loft floor,")
        found = self.read(text + loft)
        (part,) = (p for p in found.whole.shell.surfaces.values() if p.construction == "Roof")
        outer, inner = 1 / (2.6 + OUTSIDE + UP), 1 / (2.6 + 2 * UP)
        self.assertAlmostEqual(part.adjustment, outer / (outer + inner), 3)
        # The sun on the loft's roof comes through as heat from outdoors does.
        self.assertEqual((part.azimuth, part.tilt), (0, 0))
        self.assertAlmostEqual(found.whole.shell.opaque["Roof"].r_outside, OUTSIDE * outer / (outer + inner), 5)
        self.assertAlmostEqual(found.whole.shell.opaque["Roof"].film_in_sun(), 0.04 * outer / (outer + inner), 5)
        self.assertAlmostEqual(found.whole.shell.opaque["Wall"].film_in_sun(), 0.04)
        dark = self.read(text + loft.replace("Outdoors, , , ,", "Outdoors, , NoSun, ,"))
        (part,) = (p for p in dark.whole.shell.surfaces.values() if p.construction == "Roof")
        self.assertEqual((part.azimuth, part.tilt), (None, None))
        self.assertAlmostEqual(found.whole.area, ALIKE * LENGTH * DEPTH)
        self.assertTrue(any("Loft" in line for line in found.left_out))

    def test_each_zone_is_a_room(self):
        """Two rooms side by side, one twice; what they have together is what the whole has."""
        path = self.folder / "two.idf"
        path.write_text(TWO)
        found = idf_building.read_building(str(path), has_rooms=True)
        self.assertEqual([room.name for room in found.rooms], ["Room", "Store"])
        self.assertEqual([room.area for room in found.rooms], [160, 80])
        for what in ("area", "volume"):
            self.assertAlmostEqual(sum(getattr(room, what) for room in found.rooms), getattr(found.whole, what))
        self.assertAlmostEqual(sum(room.shell.conductance for room in found.rooms), found.whole.shell.conductance)
        self.assertAlmostEqual(sum(room.shell.heat_capacity for room in found.rooms), found.whole.shell.heat_capacity)
        for name, profile in found.whole.loads.items():
            power = sum(room.area * room.loads[name].values for room in found.rooms if name in room.loads)
            self.assertTrue(np.allclose(power, found.whole.area * profile.values), name)
        for flow in ("infiltration", "ventilation"):
            air = sum(room.volume * getattr(room, flow) for room in found.rooms)
            self.assertTrue(np.allclose(air, found.whole.volume * getattr(found.whole, flow)), flow)
        self.assertEqual(found.rooms[1].heating.mean(), 12)
        self.assertNotIn("people", found.rooms[1].loads)
        # The wall between: brick, wool, brick, with a film on either side.
        wall = 1 / (2 * 0.24 / 0.8 + 2.5 + 2 * INSIDE)
        said = next(line for line in found.left_out if "between rooms" in line)
        self.assertIn(f"{(ALIKE + 1) / 2 * DEPTH * HEIGHT * wall:.0f} W/K", said)

    def test_json_says_the_same(self):
        one = self.read(BOX)
        other = self.read(as_json(self.folder / "box.idf"), "box.epJSON")
        self.assertEqual((one.whole.area, one.whole.volume, one.whole.shell.conductance, one.left_out),
                         (other.whole.area, other.whole.volume, other.whole.shell.conductance, other.left_out))
        for name in one.whole.loads:
            self.assertTrue((one.whole.loads[name].values == other.whole.loads[name].values).all())
        self.assertTrue((one.whole.heating == other.whole.heating).all())

    def test_older_files_have_other_fields(self):
        old = HOUSE.replace("25.2", "8.9").replace("south, , , , 3, 4,", "south, , , , , 3, 4,") + faces(False)
        one, other = self.read(BOX), self.read(old)
        self.assertEqual((one.whole.area, one.whole.shell.conductance),
                         (other.whole.area, other.whole.shell.conductance))

    def test_lights_outside_burn_by_their_schedule_or_by_night(self):
        text = "Exterior:Lights, Front, Half, 320, {}; Schedule:Constant, Half, , 0.5;\n"
        lights = self.read(BOX + text.format("ScheduleNameOnly")).whole.loads["outside_lights"]
        self.assertEqual((lights.carrier, lights.share, set(lights.values.flat)), ("electricity", 0, {0.5 * 320 / 160}))
        lights = self.read(BOX + text.format("AstronomicalClock")).whole.loads["outside_lights"]
        self.assertEqual(set(lights.values[0, 0]), {0, 1})
        self.assertNotIn("outside_lights", self.read(BOX).whole.loads)

    def test_equipment_outside_is_a_load_by_its_fuel(self):
        """No room feels it; what a job has no meter of is told."""
        text = "Schedule:Constant, Half, , 0.5;\n" + "".join(
            f"Exterior:FuelEquipment, {name}, {fuel}, Half, 320;\n" for name, fuel in (
                ("Lift", "Electricity"), ("Charger", "Electricity"), ("Ramp", "NaturalGas"),
                ("Path", "DistrictHeatingWater"), ("Pond", "Water")))
        found = self.read(BOX + text)
        loads = {name: found.whole.loads[f"outside_{name}"]
                 for name in ("equipment", "gas_equipment", "district_equipment")}
        self.assertEqual({name: (load.carrier, load.share, float(load.values.max())) for name, load in loads.items()},
                         {"equipment": ("electricity", 0, 2), "gas_equipment": ("gas", 0, 1),
                          "district_equipment": ("district", 0, 1)})
        self.assertIn('Exterior:FuelEquipment "Pond" by Water, of which a job has no meter', found.left_out)

    def test_baseboards_by_outdoor_temperature_and_computers_are_told(self):
        said = "\n".join(self.read(BOX + "ZoneBaseboard:OutdoorTemperatureControlled, B; "
                                   "ElectricEquipment:ITE:AirCooled, C;\n").left_out)
        for words in ("ZoneBaseboard:OutdoorTemperatureControlled: baseboards", "ElectricEquipment:ITE:AirCooled: "):
            self.assertIn(words, said)

    def test_nights_are_those_of_the_place(self):
        """Sunrise and sunset at Greenwich on 21 March and 21 June, to five minutes: NOAA's solar calculator."""
        for day, end, begin in ((80, 6 + 8 / 60, 18 + 7 / 60), (172, 3 + 52 / 60, 20 + 12 / 60)):
            self.assertTrue(np.allclose(idf_outside.night(day, 51.48, 0, 0), (end, begin), atol=5 / 60))
        self.assertTrue(np.allclose(idf_outside.night(172, 80, 0, 0), (0, 24), atol=0.1))
        dark = idf_outside.dark_share((51.48, 0, 0), False)
        self.assertTrue(0.48 < dark.mean() < 0.52)
        ahead = idf_outside.dark_share((51.48, 0, 0), True)
        self.assertTrue((ahead[180, 0] == np.roll(dark[180, 0], 1)).all() and (ahead[0] == dark[0]).all())

    def test_hot_water_is_what_is_drawn_and_lost(self):
        text = "Schedule:Constant, Hot, , 60; Schedule:Constant, Warm, , 43; Schedule:Constant, Air, , 20;\n" \
               "Site:WaterMainsTemperature, Schedule, Warm;\n" \
               "WaterHeater:Mixed, Tank, 0.2, Hot, 2, 80, Cycle, 9000, , , , {fuel}, 0.8, , , , , , , , Schedule, " \
               "Air, , , 6, , 6;\n" \
               "WaterUse:Equipment, Taps, , 1e-5, Work, Hot, Hot, , Room;\n"
        water = self.read(BOX + text.format(fuel="NaturalGas")).whole.loads["hot_water"]
        self.assertEqual((water.carrier, water.share), ("gas", 0))
        lost, drawn = 6 * (59 - 20), ALIKE * 1e-5 * 4.18e6 * (60 - 43)
        self.assertAlmostEqual(160 * water.values[0, 0].min(), lost / 0.8)
        self.assertAlmostEqual(160 * water.values[0, 0].max(), (lost + drawn) / 0.8)
        without = self.read(BOX + text.format(fuel="Steam"))
        self.assertNotIn("hot_water", without.whole.loads)
        self.assertIn("hot water without", "".join(without.left_out))

    def test_hot_water_of_a_loop_is_all_hot_without_a_target(self):
        text = "Schedule:Constant, Hot, , 60; Schedule:Constant, Warm, , 43; Schedule:Constant, Always, , 1;\n" \
               "Site:WaterMainsTemperature, Schedule, Warm;\n" \
               "WaterHeater:Mixed, Tank, 0.2, Hot, 2, 80, Cycle, 9000, , , , NaturalGas, 0.8;\nWaterUse:Equipment, Taps, , 1e-5, Always, , , , Room;\n"
        self.assertNotIn("hot_water", self.read(BOX + text).whole.loads)      # all of it is cold
        on_loop = self.read(BOX + text + f"WaterUse:Connections, Loop, In, Out{', ' * 8}Taps;\n").whole
        self.assertAlmostEqual(160 * on_loop.loads["hot_water"].values.mean(),
                               ALIKE * 1e-5 * 4.18e6 * (60 - 43) / 0.8)

    def test_tanks_take_fuel_while_they_do_not_heat(self):
        text = "Schedule:Constant, Hot, , 60; Schedule:Constant, Air, , 20;\n" \
               "WaterHeater:Mixed, Tank, 0.2, Hot, 0, 80, Cycle, 9000, , , , NaturalGas, 0.8, , 500, {}, 0.25, , , , " \
               "Schedule, Air, , , 6, , 6;\n"
        for fuel, taken, given in (("NaturalGas", 500, 125), ("Electricity", 0, 0)):
            water = self.read(BOX + text.format(fuel)).whole.loads["hot_water"]
            self.assertAlmostEqual(160 * water.values.mean(), taken + (6 * 40 - given) / 0.8)

    def test_the_fuel_of_several_tanks_does_not_follow_their_order(self):
        tanks = [f"WaterHeater:Mixed, {fuel}, 0.2, Hot, 2, 80, Cycle, {size}, , , , {fuel}, 0.8, , , , , , , , "
                 "Schedule, Hot, , , 6, , 6, , 1e-5, Work;\n" for fuel, size in (("NaturalGas", 9000), ("Electricity", 5000))]
        for order in (tanks, tanks[::-1]):
            found = self.read(BOX + "Schedule:Constant, Hot, , 60;\n" + "".join(order))
            self.assertEqual(found.whole.loads["hot_water"].carrier, "gas")
            self.assertIn("WaterHeater:Mixed by electricity and gas: gas, which heats most", "".join(found.left_out))

    def test_what_draws_without_a_thermostat_is_metered(self):
        both, without_one = TWO, without(TWO, "ZoneControl:Thermostat, Frost")
        self.assertNotIn("outside_equipment", self.read(both).whole.loads)
        found = self.read(without_one)
        load = found.whole.loads["outside_equipment"]
        self.assertEqual((load.carrier, load.share), ("electricity", 0))
        self.assertAlmostEqual(160 * load.values.max(), 3 * 80)
        self.assertNotIn("Lights of zone", "".join(found.left_out))

    def test_masses_of_a_list_are_those_of_each_zone(self):
        mass = "InternalMass, Shelves, Wall, {}, , 40;\n" \
               "ZoneList, All, Room;\n"
        bare, one, of_list = (self.read(BOX + text).whole.shell.heat_capacity
                              for text in ("", mass.format("Room"), mass.format("All")))
        self.assertGreater(one, 1.1 * bare)
        self.assertEqual(of_list, one)

    def test_a_fan_of_continuous_speed_changes_its_flow(self):
        fan = "Fan:SystemModel, {}, , In, Out, {}, {}, 0, 600, 0.8, 0.5, , , , , 0.5;\n"
        found = self.read(BOX + fan.format("A", 2, "Continuous"))
        self.assertNotIn("fans", found.whole.loads)
        self.assertIn("1 Fan:SystemModel of continuous speed", "".join(found.left_out))
        one, beside = (self.read(BOX + text).whole.loads["fans"].values.max() for text in (
            fan.format("A", "autosize", "Discrete"),
            fan.format("A", "autosize", "Discrete") + fan.format("B", "autosize", "Continuous")))
        self.assertAlmostEqual(beside, one / 2)

    def test_templates_of_systems_are_refused(self):
        with self.assertRaisesRegex(Refused, "HVACTemplate:Zone:PTAC.*ExpandObjects"):
            self.read(BOX + "HVACTemplate:Zone:PTAC, Room, Stat;\n")

    def test_interpolated_schedules_and_kiva_are_told(self):
        found = self.read(BOX.replace("Work, Fraction, Through: 6/30", "Work, Fraction, Interpolate: Linear, "
                                      "Through: 6/30").replace("Slab, Room, , Ground", "Slab, Room, , Foundation"))
        self.assertIn("Interpolate: Linear", "".join(found.checks))
        self.assertIn("Foundation:Kiva", "".join(found.left_out))

    def test_mains_are_as_energyplus_has_them(self):
        """Its correlation: yearly mean 9.69 degC + 6 degF, in Chicago 28.1 K between months, coldest in winter."""
        model = types.SimpleNamespace(all=lambda kind: [types.SimpleNamespace(
            word=lambda key: "correlation", number=lambda key, *_: 9.69 if key.startswith("annual") else 28.1)])
        months = idf_outside.mains(model, None)[::31, 0, 0]
        self.assertAlmostEqual(months.mean(), 9.69 + 6 / 1.8, delta=0.5)
        self.assertLess(months[1], months[7] - 8)

    def test_what_is_left_out_is_told(self):
        said = "\n".join(self.read(BOX).left_out)
        self.assertIn("Shading:Site:Detailed", said)
        self.assertIn("48 m2 of adiabatic surfaces", said)

    def test_messages(self):
        self.refused("Version, 25.2", "Version, 7.2", "Version", "'7.2'", "8.9 to 26.x")
        self.refused("Version, 25.2;", "", "no object Version")
        self.refused("0.24, 0.8", "thick, 0.8", 'Material "Brick": thickness', "'thick'", "expected one from")
        self.refused("Wall, Brick, Wool", "Wall, Brick, Wol", 'Construction "Wall": layer_2', "'Wol'")
        self.refused("Through: 12/31", "Through: 11/30", 'Schedule:Compact "Work"', "day 335")
        self.refused("Until: 17:30, 1,\n  Until: 24:00, 0, For: Sat", "Until: 17:30, 1, For: Sat", "ends at 17:30")
        self.refused("For: Saturday", "For: Caturday", "'caturday'", "Weekdays")
        self.refused("Until: 17:30", "Until: 17h30", "'17h30'", "24:00")
        self.refused("Leaks, Room", "Leaks, Rom", "'Rom'", "zone")
        self.refused("south, , , , 3", "suoth, , , , 3", "building_surface_name", "'suoth'")
        self.refused("AirChanges/Hour", "AirChange", "design_flow_rate_calculation_method", "'airchange'")
        self.refused("0,8,3, 0,0,3, 10,0,3, 10,8,3", "0,8,3, 0,0,3", "vertices")
        self.refused("10,8,0, 10,0,0;\n", "10,8,0, 10,0,0\n", "ends within")
        for text, name in (("{", "x.epJSON"), ("[1]", "x.epJSON"), ('{"Version": {"a": {"version_identifier": "25.1"}},'
                                                                    ' "Zone": 3}', "x.epJSON"), ("", "x.idf")):
            with self.assertRaises(Refused):
                self.read(text, name)

    def test_damaged_files_end_in_a_message(self):
        """Cut anywhere, or a word of it exchanged: a Refused or a building, nothing else."""
        words = BOX.split(",")
        damaged = [BOX[:k] for k in range(0, len(BOX), 61)]
        damaged += [",".join([*words[:k], bad, *words[k + 1:]]) for k in range(0, len(words), 3)
                    for bad in (" x", " -1", " 1e99", " ;")]
        for text in damaged:
            try:
                self.read(text)
            except Refused as error:
                self.assertIn("box.idf", str(error))

    def test_fields_are_those_of_energyplus(self):
        program = energyplus.program()
        if program is None:
            self.skipTest(energyplus.HOW)
        classes = energyplus.Schema(program).classes
        by_kind = {kind.lower(): each["legacy_idd"] for kind, each in classes.items()}
        for kind in idf_fields.FIELDS:
            if kind in by_kind and kind != "coil:heating:gas":
                known = by_kind[kind]["fields"]
                ours = idf.fields_in(kind, (25, 2))
                self.assertEqual(ours, known[:len(ours)], kind)
                self.assertEqual(idf_fields.MOST_FIELDS.get(kind, len(known)), len(known), kind)
                self.assertTrue(kind not in idf_fields.WHOLE or len(ours) == len(known), kind)


class Job(usual.New):
    """Through the program; the tests of `new` itself are elsewhere."""

    def box(self, text=BOX, name="box.idf"):
        path = self.folder / name
        path.write_text(text)
        return path

    def from_file(self, path, code=0, **options):
        return self.new(code=code, idf=path, **{"area": None, "use": None, "built": None, **options})

    def test_a_job_is_checked(self):
        said = self.from_file(self.box()).stdout
        self.assertIn("left out: 1 Shading:Site:Detailed", said)
        job = self.checked()
        zone = job["zone"][0]
        self.assertEqual((zone["floor_area"], zone["volume"]), (160, 480))
        self.assertEqual(zone["heating_set_point"], {"value": 21, "low": 16, "schedule": "heating"})
        self.assertEqual(zone["cooling_set_point"], 26)
        self.assertEqual(job["plant"], {"heating_carrier": "gas", "heating_efficiency": 0.82,
                                        "cooling_carrier": "electricity", "cooling_cop": 3.4})
        heating = next(s for s in job["schedule"] if s["name"] == "heating")
        self.assertEqual(sum(heating["weekdays"]), 14)
        lights = next(s for s in job["schedule"] if s["name"] == "lights")
        self.assertEqual([p["dates"] for p in lights["period"]], ["01-01/06-30"])
        self.assertEqual({c["name"] for c in job["construction"]}, {"Wall", "Roof", "Slab"})
        names = {p["name"] for p in job["parameter"]}
        self.assertLessEqual({"envelope", "infiltration", "ventilation", "lights", "equipment", "people",
                              "heating_set_point", "heating_set_back", "cooling_set_point"}, names)
        self.assertNotIn("cooling_set_back", names)

    def test_ground_has_the_temperature_of_the_month(self):
        months = "Site:GroundTemperature:BuildingSurface, 10, 10, 11, 12, 14, 16, 18, 18, 17, 15, 13, 11;\n"
        self.from_file(self.box(BOX + months))
        job = self.checked()
        self.assertEqual(job["boundary"], [{"name": "ground",
                                            "temperature": {"value": 18, "low": 10, "schedule": "ground"}}])
        (ground,) = (s for s in job["schedule"] if s["name"] == "ground")
        self.assertNotIn("summer_time", ground)
        self.assertIn({"dates": "05-01/05-31", "every_day": 0.5}, ground["period"])
        slab = next(s for s in job["zone"][0]["surface"] if s["construction"] == "Slab")
        self.assertEqual(slab["boundary"], "ground")

    def test_a_file_whose_fuel_no_meter_shows(self):
        said = self.from_file(self.box()).stdout
        self.assertNotIn("no meter shows", said)
        only = self.new(self.made / "electricity.csv", idf=self.box(), area=None, use=None, built=None, force=True)
        self.assertIn("no meter shows the gas of heating", only.stdout)
        self.assertEqual(self.checked()["plant"]["heating_carrier"], "gas")

    def test_json_gives_the_same_job(self):
        path = self.box()
        self.from_file(path)
        one = self.checked()
        self.from_file(self.box(as_json(path), "box.epJSON"), force=True)
        self.assertEqual(one, self.checked())

    def test_a_zone_each(self):
        """Hours that rooms share are one schedule; numbers of a room's own have a factor."""
        self.assertIn("2 zones of the job", self.from_file(self.box(TWO), rooms=True).stdout)
        job = self.checked()
        self.assertEqual([zone["name"] for zone in job["zone"]], ["Room", "Store"])
        lights = [load["density"] for zone in job["zone"] for load in zone["load"] if load["name"] == "lights"]
        self.assertEqual(lights, [{"value": value, "schedule": "lights"} for value in (8, 3)])
        self.assertEqual([zone["heating_set_point"] for zone in job["zone"]],
                         [{"value": 21, "low": 16, "schedule": "heating"}, 12])
        priors = {p["name"]: p for p in job["parameter"]}
        self.assertEqual(priors["heating_set_back"]["target"], ["zone.Room.heating_set_point.low"])
        self.assertEqual(priors["people"]["target"], ["zone.Room.load.people.density"])
        self.assertEqual((priors["infiltration"]["target"], priors["infiltration"]["mode"]),
                         (["zone.*.flow.infiltration.air_change"], "factor"))

    def test_couplings_of_rooms_stand_behind_a_mark_for_studies_that_take_them(self):
        self.from_file(self.box(TWO), rooms=True)
        text = re.sub("^# ", "", self.job.read_text().partition("[[zone]]")[2], flags=re.M)
        self.job.write_text(self.job.read_text().partition("[[zone]]")[0] + "[[zone]]" + text)
        self.assertIn("coupled zones", self.run_program("check", self.job).stderr)
        self.job.write_text(self.job.read_text().replace('kind = "loop"', 'kind = "screening"\nn_points = 64'))
        room, _ = self.checked()["zone"]
        self.assertEqual([coupling["zone"] for coupling in room["coupling"]], ["Store"])
        self.assertAlmostEqual(room["coupling"][0]["conductance"], 1.5 * DEPTH * HEIGHT / (
            2 * 0.24 / 0.8 + 2.5 + 2 * INSIDE), 2)

    def test_a_box_without_windows_loads_and_systems(self):
        gone = ("FenestrationSurface", "People", "Lights", "ElectricEquipment", "Coil", "ZoneControl", "ZoneInf",
                "Sizing")
        text = "".join(line + "\n" for line in BOX.splitlines() if not line.startswith(gone))
        self.from_file(self.box(text))
        self.checked()

    def test_rooms_that_much_air_enters_are_in_the_range_of_a_flow(self):
        """The largest air change times the most of the factor, written with three digits, is what a job takes."""
        for air, most in (("12", 1.66), ("25", 1)):
            windy = f"ZoneInfiltration:DesignFlowRate, Gate, Store, , AirChanges/Hour, , , , {air};\n"
            self.from_file(self.box(TWO + windy), rooms=True, force=True)
            (prior,) = (p for p in self.checked()["parameter"] if p["name"] == "infiltration")
            self.assertEqual((prior["mode"], prior["max"]), ("factor", most))

    def test_the_heat_capacity_is_expected_to_be_the_file_s(self):
        self.from_file(self.box())
        job = self.checked()
        (prior,) = (p for p in job["parameter"] if p["name"] == "heat_capacity")
        self.assertEqual(prior["prior"]["mean"], job["zone"][0]["heat_capacity"])
        self.assertAlmostEqual(prior["prior"]["sd"], 0.3 * prior["prior"]["mean"], delta=500)
        self.new(force=True)
        (prior,) = (p for p in self.checked()["parameter"] if p["name"] == "heat_capacity")
        self.assertEqual((prior["prior"]["mean"], prior["prior"]["sd"]), (165000, 100000))

    def test_equipment_outside_is_in_the_job(self):
        self.from_file(self.box(BOX + "Exterior:FuelEquipment, Lift, Electricity, Work, 320;\n"))
        job = self.checked()
        (load,) = (each for each in job["zone"][0]["load"] if each["name"] == "outside_equipment")
        self.assertEqual((load["density"]["value"], load["carrier"], load["heat_fraction"]), (2, "electricity", 0))
        self.assertIn("outside_equipment", {p["name"] for p in job["parameter"]})

    def test_recovered_heat_is_in_the_flow(self):
        text = "ZoneHVAC:EquipmentConnections, Room, List;\nZoneHVAC:EquipmentList, List, SequentialLoad, " \
               "ZoneHVAC:EnergyRecoveryVentilator, Unit, 1, 1;\nZoneHVAC:EnergyRecoveryVentilator, Unit, , Wheel, " \
               "0.02;\nHeatExchanger:AirToAir:SensibleAndLatent, Wheel, , 0.02, 0.7;\n"
        self.from_file(self.box(BOX + text))
        flows = {flow["name"]: flow for flow in self.checked()["zone"][0]["flow"]}
        self.assertEqual((flows["ventilation"]["air_change"], flows["ventilation"]["heat_recovery"]), (0.3, 0.7))
        self.assertNotIn("heat_recovery", flows["infiltration"])

    def test_limits_of_ideal_loads_are_in_the_job(self):
        """The range of the prior begins at half of a passive house's power, of less than that at half of the limit."""
        for limit, least in (("800", 5), ("80", 0.5)):
            self.from_file(self.box(ideal(heating_limit="LimitCapacity", maximum_sensible_heating_capacity=limit,
                                          cooling_availability_schedule_name="Never")), force=True)
            job = self.checked()
            (prior,) = (p for p in job["parameter"] if p["name"] == "heating_capacity")
            self.assertEqual((job["zone"][0]["heating_capacity"], prior["prior"]["mean"], prior["min"]),
                             (float(limit) / 80, float(limit) / 80, least))
            self.assertEqual((job["zone"][0]["cooling_capacity"], job["plant"]["cooling_carrier"]), (0, "none"))
        self.from_file(self.box(ideal(heating_availability_schedule_name="Never")), force=True)
        job = self.checked()
        self.assertEqual((job["zone"][0]["heating_capacity"], job["zone"][0]["cooling_capacity"]), (0, 90))
        self.assertNotIn("heating_capacity", {p["name"] for p in job["parameter"]})
        self.from_file(self.box(ideal(TWO, heating_limit="LimitCapacity", maximum_sensible_heating_capacity="800")),
                       force=True, rooms=True)
        job = self.checked()
        self.assertEqual([zone["heating_capacity"] for zone in job["zone"]], [10, 100])
        (prior,) = (p for p in job["parameter"] if p["name"] == "heating_capacity")
        self.assertEqual((prior["mode"], prior["target"]), ("factor", ["zone.*.heating_capacity"]))

    def test_set_points_without_a_thermostat_are_told(self):
        said = self.from_file(self.box(without(BOX, "ZoneControl"))).stdout
        self.assertIn("check this: heating_set_point and cooling_set_point: box.idf has no thermostat", said)
        job = self.checked()
        self.assertLess(job["zone"][0]["cooling_set_point"], 30)
        self.assertEqual(job["plant"]["cooling_carrier"], "electricity")
        said = self.from_file(self.box(without(BOX, "ZoneControl", "Coil:Cooling")), force=True).stdout
        self.assertIn("check this: heating_set_point: box.idf has no thermostat", said)
        self.assertEqual(self.checked()["zone"][0]["cooling_set_point"], 60)
        only = BOX.replace("ThermostatSetpoint:DualSetpoint, Both", "ThermostatSetpoint:SingleHeating, Both").replace(
            "SingleHeating, Both, Heat, Cool;", "SingleHeating, Both, Heat;")
        said = self.from_file(self.box(only), force=True).stdout
        self.assertIn("has Coil:Cooling:DX:SingleSpeed, but its thermostats no cooling set-point", said)
        self.assertIn("# no cooling set-point in the file", self.job.read_text())
        self.assertNotIn("has no thermostat", self.from_file(self.box(), force=True).stdout)

    def test_options(self):
        self.assertIn("leave it out beside --idf", self.from_file(self.box(), USAGE, area=100).stderr)
        self.assertIn("--area", self.new(code=USAGE, area=None).stderr)
        self.assertIn("expected --idf", self.new(code=USAGE, rooms=True).stderr)
        self.assertIn("leave out either", self.from_file(self.box(), USAGE, rooms=True, simulator=True).stderr)
        self.assertIn("expected an EnergyPlus file", self.from_file(self.folder / "none.idf", NO_INPUT).stderr)
        path = self.box(name="box.toml")
        self.assertIn("is an input", self.from_file(path, usual.EXISTS, job=path, force=True).stderr)


if __name__ == "__main__":
    tests = unittest.TestSuite()
    for case in (Box, Job):
        names = [name for name in vars(case) if name.startswith("test_")]
        tests.addTests(case(name) for name in names)
    done = unittest.TextTestRunner().run(tests)
    sys.exit(not done.wasSuccessful())
