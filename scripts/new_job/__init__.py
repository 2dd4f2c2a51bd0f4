"""A first job from little: what scripts/new writes. Modules from the ground up: refused, words, times, tables,
workbook, exports, places, envelopes, uses, weather, meters, periods, building, priors, job; and of an EnergyPlus
file: idf_fields, idf_text, idf, idf_files, idf_schedules, idf_geometry, idf_envelope, idf_fans, idf_ventilators,
idf_ideal, idf_use, idf_plant, idf_building, idf_job."""
