/// Change of the norm of a wave function, on a logarithmic axis.
#include "engine/figure/build.hpp"

namespace extremal::views {
namespace {

Figure makeNorm(const FigureContext& context) {
    Figure figure = startFigure(context, "Norm error");
    figure.x = timeAxis(context);
    figure.y = logAxis("|‖ψ‖ − ‖ψ(0)‖|");
    addAgainstTime(figure, context, "norm_error", Take::magnitude);
    figure.floor = 0x1p-52;
    finishFigure(figure, context, "Norm error against time");
    return figure;
}

}  // namespace

ViewEntry norm() {
    return {{"norm", "Norm error", "change of the norm of the wave function against time, logarithmic", {}, {}, {}},
            "norm", makeNorm, nullptr, logAgainstTime};
}

}  // namespace extremal::views
