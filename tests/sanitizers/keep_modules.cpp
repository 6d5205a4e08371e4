// SPDX-License-Identifier: GPL-3.0-or-later
/// Part of every program that is built with sanitizers: modules that were loaded at run time, as the drivers
/// of OSMesa and the plugins of Qt are, stay loaded to the end. Reports at the end then name them, which
/// those of modules that are gone cannot, and lists of what is not ours to mend (leaks.txt, races.txt) can
/// name them too.
extern "C" int dlclose(void*);

int dlclose(void*) { return 0; }
