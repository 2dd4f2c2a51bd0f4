/// Nothing: with this source the headers that all tests include are compiled once.
