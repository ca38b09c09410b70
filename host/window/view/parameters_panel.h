// Every parameter as a labelled control with its value.
#pragma once

#include <array>
#include <optional>

#include "window/model/control.h"
#include "window/view/panel.h"

namespace jawari::host::window {

class ParametersPanel : public Panel {
  public:
    explicit ParametersPanel(Shared& shared);

    void draw_still(Canvas& canvas) override;
    void follow(double passed_s) override;
    bool press(const Pointer& pointer) override;
    void drag(const Pointer& pointer) override;
    void release(const Pointer& pointer) override;
    bool hover(const Pointer& pointer) override;
    void leave() override;
    bool scroll(const Pointer& pointer, float lines) override;
    [[nodiscard]] std::size_t stops() const override { return parameter_count; }
    bool key(const KeyPress& press) override;

  private:
    [[nodiscard]] std::optional<ParameterId> at(const Pointer& pointer) const;
    void set_once(ParameterId parameter, double value);
    void draw(Canvas& canvas, const ParameterDeclaration& parameter);

    struct Hold {
        ParameterId parameter{};
        ControlDrag drag;
        float x = 0;
    };

    std::array<double, parameter_count> shown_{};
    std::optional<Hold> hold_;
    std::optional<ParameterId> under_;  ///< the pointer
};

}  // namespace jawari::host::window
