"""Case folders as jobs: building.json, weather and readings become what bemcal-batch reads."""
