"""A user's own EnergyPlus model, run for the hours of a job: parameters and effects enter it by tables, never as text.

`runner` is the order of things, `model` holds the objects, `parameters` and `effects` are the two tables. Source of
classes and fields: EnergyPlus Input Output Reference; of actuators: its EMS Application Guide.
"""
