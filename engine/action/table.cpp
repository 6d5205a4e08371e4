#include "engine/action/table_build.hpp"

namespace extremal {

template Table<double> makeTable(const Space<double>&, const Rule<double>&);

}  // namespace extremal
