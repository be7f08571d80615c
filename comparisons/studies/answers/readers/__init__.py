"""Files of answers from outside: tables of pressures, and results on any mesh."""
