// What a window shows and plays: implemented by `jawari play` and by the plugin. The window is a module of
// its own (load_window.h), so nothing here needs OpenGL or a display.
#pragma once

#include <optional>
#include <string>

#include "instrument/instrument_cache.h"
#include "jawari/parameters.h"
#include "stage/stage_link.h"

namespace jawari::host::window {

/// The preset that plays, or is about to.
struct PresetInForce {
    std::string name;             ///< for people
    std::string text;             ///< of the preset file
    SharedInstrument instrument;  ///< compiled; null: nothing is yet
    unsigned version = 0;         ///< another number for another preset
    bool edited = false;          ///< text is not what the name stands for
};

/// What the window's meters show beside StagePicture.
struct PerformanceFacts {
    int quality_level = 0;   ///< 0: full
    bool adapts = false;     ///< the level may be lowered
    bool compiling = false;  ///< another preset is on its way
    bool runs = true;        ///< sound is asked for
};

/// Everything is called by the window's thread alone, and comes back soon: nothing is compiled meanwhile.
class Performance {
  public:
    Performance() = default;
    Performance(const Performance&) = delete;
    Performance& operator=(const Performance&) = delete;
    Performance(Performance&&) = delete;
    Performance& operator=(Performance&&) = delete;
    virtual ~Performance() = default;

    virtual StageLink& link() = 0;
    /// An event waits in the link: a host that lets the instance sleep is to wake it.
    virtual void wake() = 0;

    /// In force, in the parameter's unit.
    [[nodiscard]] virtual double value(ParameterId parameter) const = 0;
    /// Whether this parameter can be changed from here.
    [[nodiscard]] virtual bool can_edit(ParameterId parameter) const = 0;
    /// A control is taken hold of, moved, let go.
    virtual void begin_edit(ParameterId parameter) = 0;
    virtual void edit(ParameterId parameter, double value) = 0;
    virtual void end_edit(ParameterId parameter) = 0;

    [[nodiscard]] virtual const PresetInForce& preset() const = 0;
    /// By the name of the preset library; in force once it is compiled.
    virtual void load_preset(const std::string& name) = 0;
    /// The text of a preset file under the name in force; parameters stay. In force once it is compiled; of
    /// several that wait the latest.
    virtual void edit_preset(const std::string& text) = 0;

    virtual PerformanceFacts facts() = 0;
    /// The next line to tell whoever plays, oldest first.
    virtual std::optional<std::string> notice() = 0;
};

}  // namespace jawari::host::window
