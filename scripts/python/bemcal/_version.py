"""The version of the package: that of the program it came with."""
VERSION = "0.2.0"
