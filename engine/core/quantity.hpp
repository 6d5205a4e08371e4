/// A number that has a name, for files and plots.
#pragma once

#include <string>

namespace extremal {

struct Quantity {
    std::string name;    ///< in files: "attitude.w"
    std::string title;   ///< "attitude w"; may be empty
    std::string symbol;  ///< in plots
    std::string unit;    ///< empty if dimensionless
};

}  // namespace extremal
