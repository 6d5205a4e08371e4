/// The mean position <x> of a wave function, and <cos x>, which a periodic domain knows without a cut; on a
/// rectangle <x> and <y>.
#include <vector>

#include "engine/observe/catalog.hpp"
#include "engine/model/wave/spectrum.hpp"

namespace extremal::observables {

ObservableEntry position() {
    ObservableEntry e;
    e.item = {"position",
              "position",
              "Mean position of the wave function; on a periodic interval the mean of cos x too.",
              {},
              {},
              "a wave function"};
    e.applies = [](const System& system) { return system.hasWave(); };
    e.bind = [](const ObserveContext& context) {
        Observer o;
        o.columns = {{"position", "⟨x⟩", "", {}, {}}};
        const Hamiltonian& wave = *context.system.wave;
        if (wave.isPlane())
            o.columns.push_back({"position_y", "⟨y⟩", "", {}, {}});
        else if (wave.isPeriodic())
            o.columns.push_back({"cos_x", "⟨cos x⟩", "", {}, {}});
        o.evaluate = [h = context.system.wave,
                      work = std::vector<Complex>(static_cast<std::size_t>(wave.size()))](
                         const NodeBlock& nodes, double* values, std::size_t stride) mutable {
            for (std::size_t i = 0; i < nodes.size(); ++i, values += stride) {
                const NodeMeans means = nodeMeans(*h, coefficients(nodes.x(i)), work.data());
                values[0] = means.x;
                if (h->isPeriodic()) values[1] = h->isPlane() ? means.y : means.cosine;
            }
        };
        return o;
    };
    return e;
}

}  // namespace extremal::observables
