/// The animated picture: a view, but no plot.
#include "engine/figure/view.hpp"

namespace extremal::views {

ViewEntry stage() {
    return {{"stage", "Stage", "the moving picture of all schemes at one time", {}, {}, {}},
            "",
            nullptr,
            nullptr,
            noScales};
}

}  // namespace extremal::views
