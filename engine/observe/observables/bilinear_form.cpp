/// The bilinear form that three-level schemes for wave functions conserve, between the previous node and this
/// one, and its change. Empty at the first node, and for one-step schemes, which conserve the norm.
#include <cmath>
#include <limits>
#include <vector>

#include "engine/family/wave/wave_three_level.hpp"
#include "engine/observe/catalog.hpp"

namespace extremal::observables {
namespace {

struct Form {
    std::shared_ptr<const Hamiltonian> h;
    double alpha = 0, dt = 0, shift = 0;
    std::vector<Complex> before, image, work;
    long long node = -1;
    double value = std::numeric_limits<double>::quiet_NaN(), first = value;

    void look(long long at, const double* x) {
        const Complex* c = coefficients(x);
        if (at == node) return;  // the same node again
        if (at == node + 1 && node >= 0)
            value = bilinearForm(*h, alpha, dt, shift, before.data(), c, image.data(), work.data());
        if (!(first == first)) first = value;
        before.assign(c, c + h->size());
        node = at;
    }
};

}  // namespace

ObservableEntry bilinear_form() {
    ObservableEntry e;
    e.item = {"bilinear-form",
              "bilinear form",
              "What three-level schemes of wave functions keep in place of the norm.",
              {},
              {},
              "a wave function"};
    e.applies = [](const System& system) { return isWave(system); };
    e.bind = [](const ObserveContext& context) {
        Observer o;
        o.extreme = 1;
        o.columns = {{"bilinear_form", "J", "", {}, {}}, {"bilinear_form_error", "J - J(0)", "", {}, {}}};
        const bool isPair = context.pair != nullptr,
                   isThreeLevel = isPair && context.pair->space.text("form") == "three-level";
        if (isPair && !isThreeLevel) {
            o.evaluate = [](const State&, const StepReport&, double* values) {
                values[0] = values[1] = std::numeric_limits<double>::quiet_NaN();
            };
            return o;
        }
        Form form;
        form.h = context.system.hamiltonian();
        form.dt = context.step;
        if (isThreeLevel) {
            form.alpha = threeLevelAlpha(context.pair->quadrature);
            const Value* shift = context.pair->space.find("energy_shift");
            form.shift = shift && shift->isNumber()
                             ? shift->asNumber()
                             : form.h->energy(context.initial.t, coefficients(context.initial.x.data()));
        }
        form.image.resize(static_cast<std::size_t>(form.h->size()));
        form.work = form.image;
        o.evaluate = [form](const NodeBlock& nodes, double* values, std::size_t stride) mutable {
            for (std::size_t i = 0; i < nodes.size(); ++i, values += stride) {
                form.look(nodes.node(i), nodes.x(i));
                values[0] = form.value;
                values[1] = form.value - form.first;
            }
        };
        return o;
    };
    return e;
}

}  // namespace extremal::observables
