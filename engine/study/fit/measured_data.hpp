// SPDX-License-Identifier: GPL-3.0-or-later
/// Measurements of a motion, from a CSV file: the column t, and columns of the state by their names (q.theta,
/// or theta for a coordinate). Each has its own times: an empty cell was not measured. A column sd.NAME has
/// the standard deviations of NAME, weight.NAME their inverse squares; what has weight 0 is left out.
/// Without either all of a column weigh the same. Lines that begin with # say what the data are.
#pragma once

#include <istream>
#include <string>
#include <vector>

#include "engine/model/system.hpp"

namespace extremal {

struct Measurement {
    double t = 0;
    std::size_t column = 0;  ///< of MeasuredData::columns
    double value = 0;
    double deviation = 1;
};

struct MeasuredData {
    struct Each {
        std::string name;       ///< as the file has it
        std::size_t entry = 0;  ///< of the state
    };
    std::string name = {};    ///< of the file
    std::string remark = {};  ///< what the file says about itself in lines with #
    std::vector<Each> columns;
    std::vector<Measurement> all;  ///< by their times
    bool hasDeviations = false;    ///< of every column
};

/// `only`: names of the columns to be read; empty: all, which must then be columns of the state. Throws
/// InvalidScene ("--data", "--columns").
MeasuredData readMeasuredData(std::istream& in, const std::string& name, const System& system,
                              const std::vector<std::string>& only);
/// Of a file, which is read whole.
MeasuredData readMeasuredFile(const std::string& path, const System& system,
                              const std::vector<std::string>& only);

}  // namespace extremal
