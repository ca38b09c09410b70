// A simulation that advances when it is told to, whose state can be looked at in between.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/error.h"
#include "formats/scene/probe_names.h"
#include "formats/scene/scene.h"
#include "jawari/detail/string_model.h"
#include "jawari/detail/string_state.h"
#include "recording.h"

namespace jawari::python {

class Stepper {
  public:
    static host::Outcome<std::unique_ptr<Stepper>> create(host::Scene scene, const RecordOptions& options);

    /// At the same time, from the same state; the model is shared.
    [[nodiscard]] std::unique_ptr<Stepper> copy() const;

    [[nodiscard]] const host::Scene& scene() const { return *scene_; }
    [[nodiscard]] const SceneModel& model() const { return *model_; }
    [[nodiscard]] const SceneState& state() const { return state_; }
    [[nodiscard]] const std::vector<host::ProbeLabel>& labels() const { return labels_; }
    /// Output frames since t = 0.
    [[nodiscard]] std::uint64_t frame() const { return state_.frame; }
    [[nodiscard]] double time_s() const;
    /// Values of all probes now, as render() gives them at the row of this time.
    [[nodiscard]] std::vector<double> probe_values() const;
    /// S q - b of the contacts that take part [m].
    [[nodiscard]] std::vector<double> gaps(std::size_t string) const;
    /// Of the description, those that take part.
    [[nodiscard]] std::vector<std::size_t> contacts(std::size_t string) const;

    /// Appends the probes' values of `frames` rows, the present one first, to `values` (one vector per
    /// probe).
    void advance(std::size_t frames, std::vector<std::vector<double>>& values);
    /// Sets modal displacement and backward velocity of a string; sizes are those of its modes.
    void set_modes(std::size_t string, const double* displacement, const double* velocity);
    /// Starts moving an obstacle linearly to a new height.
    void move_contact(std::size_t string, std::size_t contact, double height_m, double duration_s);
    void reset();
    /// Everything that the simulation goes on from (scene/snapshot.h).
    [[nodiscard]] std::vector<std::uint8_t> save() const;
    /// True if it goes on with the same bits, false if the state was converted from other rates or settings.
    host::Outcome<bool> restore(std::span<const std::uint8_t> bytes);

    /// One thread at a time may work with a simulation: false if another one does.
    bool claim() { return !busy_.exchange(true); }
    void release() { busy_.store(false); }

  private:
    Stepper(std::shared_ptr<const host::Scene> scene, std::shared_ptr<const SceneModel> model,
            SceneState state, std::vector<host::ProbeLabel> labels);

    std::shared_ptr<const host::Scene> scene_;
    std::shared_ptr<const SceneModel> model_;
    SceneState state_;
    std::vector<host::ProbeLabel> labels_;
    std::atomic<bool> busy_{false};
};

}  // namespace jawari::python
