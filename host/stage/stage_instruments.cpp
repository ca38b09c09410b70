// Which instruments are on the stage.
#include <algorithm>
#include <cmath>
#include <utility>

#include "stage/stage.h"

namespace jawari::host {

std::unique_ptr<StagedInstrument> make_staged(const SharedInstrument& loaded, const StageSettings& settings) {
    auto staged = std::make_unique<StagedInstrument>();
    staged->loaded = loaded;
    staged->state = make_instrument_state(loaded->model);
    const bool guitar = settings.interpreter.guitar_channel >= 0;
    set_play_mode(staged->state, guitar ? PlayMode::Guitar : PlayMode::Keyboard);
    staged->left.assign(settings.most_frames, 0.0);
    staged->right.assign(settings.most_frames, 0.0);
    if (!settings.string_outputs) return staged;
    staged->strings.assign(loaded->model.strings.size(), std::vector<double>(settings.most_frames));
    for (std::vector<double>& string : staged->strings) staged->string_places.push_back(string.data());
    return staged;
}

void Stage::retire(StagedInstrument* instrument) JAWARI_REALTIME {
    retired_[retired_count_++] = instrument;
}

StagedInstrument* Stage::next_retired() JAWARI_REALTIME {
    return retired_count_ == 0 ? nullptr : retired_[--retired_count_];
}

void Stage::call(StagedInstrument* instrument) JAWARI_REALTIME {
    if (waiting_ != nullptr) retire(waiting_);
    waiting_ = instrument;
}

/// While as many instruments sound as may, the oldest fades first.
void Stage::take_stage() JAWARI_REALTIME {
    take_window_events();
    if (waiting_ == nullptr) return;
    if (sounding_ == most_sounding) {
        stage_[sounding_ - 1]->fading = true;
        return;
    }
    if (waiting_->interpreter) {
        fresh_ = *waiting_->interpreter;
        interpreter_.settings = fresh_.settings;
    }
    if (sounding_ > 0) inherit_controls(stage_[0]->state, waiting_->state);
    set_clock(waiting_->state, frame_ - clock_origin_);
    std::move_backward(stage_.begin(), stage_.begin() + static_cast<std::ptrdiff_t>(sounding_),
                       stage_.begin() + static_cast<std::ptrdiff_t>(sounding_) + 1);
    stage_[0] = std::exchange(waiting_, nullptr);
    sounding_ += 1;
}

void Stage::retire_silent() JAWARI_REALTIME {
    std::size_t kept = std::min<std::size_t>(sounding_, 1);
    for (std::size_t i = 1; i < sounding_; ++i) {
        StagedInstrument& old = *stage_[i];
        if (static_cast<double>(old.ring_frames) > settings_.ring_out_s * settings_.rate_hz)
            old.fading = true;
        const bool faded = old.fading && static_cast<double>(old.fade_frame) > fade_frames();
        if (faded || at_rest(old.state)) {
            retire(&old);
        } else {
            stage_[kept++] = &old;
        }
    }
    sounding_ = kept;
}

bool Stage::rests() const JAWARI_REALTIME {
    const bool asked = settings_.link != nullptr && settings_.link->has_events();
    return waiting_ == nullptr && !asked && gain_ == gain_target_ &&
           std::all_of(stage_.begin(), stage_.begin() + static_cast<std::ptrdiff_t>(sounding_),
                       [](const StagedInstrument* one) { return at_rest(one->state); });
}

void Stage::skip_silence(std::uint64_t frames) JAWARI_REALTIME {
    if (frames == 0 || !rests()) return;
    frame_ += frames;
    for (StagedInstrument* one : sounding()) set_clock(one->state, frame_ - clock_origin_);
}

void Stage::restart_clock() JAWARI_REALTIME {
    for (const StagedInstrument* one : sounding())
        if (!at_rest(one->state)) return;
    clock_origin_ = frame_;
    for (StagedInstrument* one : sounding()) set_clock(one->state, 0);
}

void Stage::reset() JAWARI_REALTIME {
    while (sounding_ > 1) retire(stage_[--sounding_]);
    if (waiting_ != nullptr && sounding_ == 1) retire(stage_[--sounding_]);
    frame_ = 0;
    clock_origin_ = 0;
    events_.clear();
    gain_ = gain_target_;
    take_stage();
    interpreter_ = fresh_;
    if (sounding_ == 0) return;
    InstrumentState& state = stage_[0]->state;
    const PlayMode mode = state.play;
    jawari::reset(stage_[0]->loaded->model, state);
    set_play_mode(state, mode);
}

void Stage::clear() JAWARI_REALTIME {
    while (sounding_ > 0) retire(stage_[--sounding_]);
    call(nullptr);
}

}  // namespace jawari::host
