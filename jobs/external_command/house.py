#!/usr/bin/env python3
"""Stands for any simulator: a house in a steady month, from house.json to gas.csv.

    python3 house.py house.json
"""
import json
import sys

FLOOR_AREA, WALL_AREA, VOLUME, DAYS = 120, 180, 300, 30
GAINS = 350  # W


def main():
    with open(sys.argv[1]) as file:
        house = json.load(file)
    heat_loss = WALL_AREA * house["u_value"] + 0.34 * VOLUME * house["air_change"]  # W/K
    needed = max(0.0, heat_loss * (house["set_point"] - house["outdoor"]) - GAINS)  # W
    with open("gas.csv", "w") as file:
        file.write("day,gas [kWh]\n")
        for day in range(DAYS):
            file.write(f"{day + 1},{needed * 0.024 / house['efficiency']:.6f}\n")
    print(f"heat loss: {heat_loss:.3f} W/K")


main()
