// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/files/starts_files.hpp"

#include <limits>

#include "engine/run/files/export.hpp"

namespace extremal {
std::vector<std::pair<std::string, const StartSet*>> startFiles(const Comparison& comparison) {
    std::vector<std::pair<std::string, const StartSet*>> files;
    if (const StartSets* sets = comparison.products.find<StartSets>())
        for (const StartSet& set : sets->all)
            files.emplace_back(files.empty() ? "starts" : "starts-" + std::to_string(files.size() + 1), &set);
    return files;
}

std::string statusOf(const Orbit* orbit) {
    if (!orbit) return "waiting";
    if (orbit->start.empty()) return "no start";
    return orbit->outcome == Outcome::converged ? "done" : std::string(name(orbit->outcome));
}

std::string startsCsv(const StartSet& set) {
    std::string text = "scheme,start," + csvCell(set.plane.x) + "," + csvCell(set.plane.y) +
                       ",lyapunov,megno,steps,points,status\n";
    for (std::size_t i = 0; i < set.orbits.size(); ++i) {
        const Orbit* const orbit = set.orbits[i].get();
        text += csvCell(set.scheme) + "," + std::to_string(i + 1);
        const double unknown = std::numeric_limits<double>::quiet_NaN();
        for (const double value : {orbit ? orbit->x : unknown, orbit ? orbit->y : unknown,
                                   orbit ? orbit->lyapunov : unknown, orbit ? orbit->megno : unknown})
            addNumber(text, value);
        text += "," + (orbit ? std::to_string(orbit->steps) : "") + "," +
                (orbit ? std::to_string(orbit->points.rows()) : "") + "," + csvCell(statusOf(orbit)) + "\n";
    }
    return text;
}

std::string startPointsCsv(const StartSet& set) {
    std::string text;
    for (std::size_t i = 0; i < set.orbits.size(); ++i) {
        if (!set.orbits[i]) continue;
        const Trajectory& points = set.orbits[i]->points;
        if (text.empty()) {
            text = "start";
            for (std::size_t c = 0; c < points.columns.size(); ++c)
                text += "," + csvCell(c == 0 ? points.columns[c].symbol : points.columns[c].name);
            text += '\n';
        }
        for (std::size_t r = 0; r < points.rows(); ++r) {
            text += std::to_string(i + 1);
            for (const Column& c : points.columns) addNumber(text, c.values[r]);
            text += '\n';
        }
    }
    return text;
}

}  // namespace extremal
