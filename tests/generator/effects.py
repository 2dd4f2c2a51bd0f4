"""Causes that a modeller may not know of, switched on by name: each changes the drives.

None is on by default. INSIDE are of the kinds that a catalogue of effects can express, OUTSIDE are
not. Sizes are in the effect's own unit.
"""
import effects_outdoors
import effects_outside
import effects_plant
import effects_use

INSIDE = effects_outdoors.EFFECTS | effects_use.EFFECTS | effects_plant.EFFECTS
OUTSIDE = effects_outside.EFFECTS
EFFECTS = INSIDE | OUTSIDE


def apply_effects(drives, office, sizes):
    """`sizes`: name -> size, None = the table's."""
    for name, size in sizes.items():
        effect = EFFECTS[name]
        effect.apply(drives, office, effect.size if size is None else size)
