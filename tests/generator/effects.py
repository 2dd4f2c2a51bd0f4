"""Causes that a modeller may not know of, switched on by name: each changes the drives.

None is on by default. INSIDE are of the kinds that a catalogue of effects can express, OUTSIDE are
not, OPERATION are what meters of real buildings showed. Sizes are in the effect's own unit.
"""
import effects_operation
import effects_outdoors
import effects_outside
import effects_plant
import effects_use

INSIDE = effects_outdoors.EFFECTS | effects_use.EFFECTS | effects_plant.EFFECTS
OUTSIDE = effects_outside.EFFECTS
OPERATION = effects_operation.EFFECTS
EFFECTS = INSIDE | OUTSIDE | OPERATION


def apply_effects(drives, office, sizes):
    """`sizes`: name -> size, None = the table's. Returns {name: what it drew} of those that say so."""
    drawn = {}
    for name, size in sizes.items():
        effect = EFFECTS[name]
        size = effect.size if size is None else size
        if effect.details:
            drawn[name] = effect.details(drives, office, size)
        effect.apply(drives, office, size)
    return drawn
