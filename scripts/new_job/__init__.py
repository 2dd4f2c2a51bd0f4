"""A first job from little: what scripts/new writes. Modules from the ground up: refused, words, times, tables,
workbook, exports, places, envelopes, uses, weather, meters, periods, building, priors, job."""
