#include "engine/action/table_build.hpp"

namespace extremal {

template Table<double> makeTable(const Space<double>&, const Rule<double>&);
template std::vector<double> weightsUpTo(const Table<double>&, const double&);

}  // namespace extremal
