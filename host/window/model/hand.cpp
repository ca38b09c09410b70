#include "window/model/hand.h"

#include <algorithm>

namespace jawari::host::window {

namespace {

constexpr double slide_time_s = 0.05;
constexpr double fast_release = 1;
/// A string that was plucked just now may not have moved in a picture yet.
constexpr int pictures_to_wait = 10;

}  // namespace

void Hand::send(const InstrumentEvent& event) {
    performance_->link().send(event);
    performance_->wake();
}

void Hand::set(ParameterId parameter, double value) {
    const ParameterDeclaration& declared = declaration_of(parameter);
    send(set_parameter(0, parameter, std::clamp(value, declared.low, declared.high), hand_channel));
}

void Hand::restore(ParameterId parameter) {
    set(parameter, performance_->value(parameter));
}

void Hand::pluck(std::size_t string, int key, double factor, double velocity) {
    if (key < 0 || string >= ringing_.size()) return;
    set(ParameterId::PluckPosition, factor);
    send(note_on_string(0, static_cast<int>(string), key, std::clamp(velocity, 0.01, 1.0), hand_channel));
    restore(ParameterId::PluckPosition);
    ringing_[string] = key;
    waited_[string] = 0;
}

void Hand::press(std::size_t string, int key, double velocity) {
    lift();
    if (key < 0 || string >= ringing_.size()) return;
    send(note_on_string(0, static_cast<int>(string), key, std::clamp(velocity, 0.01, 1.0), hand_channel));
    ringing_[string] = -1;
    pressed_ = Pressed{string, key};
}

/// The old key goes up after the new one is down: an overlap is what makes a slide.
void Hand::slide(int key) {
    if (!pressed_ || key < 0 || key == pressed_->key) return;
    set(ParameterId::Legato, 1);
    set(ParameterId::SlideTime, slide_time_s);
    constexpr double velocity = 0.5;
    send(note_on_string(0, static_cast<int>(pressed_->string), key, velocity, hand_channel));
    send(note_off(0, pressed_->key, neutral_release_velocity, hand_channel));
    restore(ParameterId::Legato);
    restore(ParameterId::SlideTime);
    pressed_->key = key;
}

void Hand::lift() {
    if (!pressed_) return;
    send(note_off(0, pressed_->key, neutral_release_velocity, hand_channel));
    pressed_.reset();
}

void Hand::release(std::size_t string) {
    if (ringing_[string] < 0) return;
    send(note_off(0, ringing_[string], fast_release, hand_channel));
    ringing_[string] = -1;
}

void Hand::mute(std::size_t string, const StagePicture* picture) {
    if (string >= ringing_.size()) return;
    if (pressed_ && pressed_->string == string) lift();
    release(string);
    if (picture == nullptr || string >= picture->string_count) return;
    const StringPicture& seen = picture->strings[string];
    if (!seen.moves || !seen.held) return;
    for (std::size_t n = 0; n < picture->note_count; ++n) {
        const HeldPicture& note = picture->notes[n];
        // Strings of a course sound one key.
        if (note.string == string || note.key == seen.key)
            send(note_off(0, note.key, fast_release, note.channel));
    }
}

void Hand::lay_palm(bool down) {
    if (down == palm_) return;
    palm_ = down;
    const double value = down ? 1.0 : performance_->value(ParameterId::PalmMute);
    send(set_parameter(0, ParameterId::PalmMute, value, every_channel));
}

void Hand::follow(const StagePicture& picture) {
    for (std::size_t s = 0; s < std::min(picture.string_count, ringing_.size()); ++s) {
        if (ringing_[s] < 0) continue;
        if (waited_[s] < pictures_to_wait)
            waited_[s] += 1;
        else if (!picture.strings[s].moves)
            release(s);
    }
}

void Hand::let_go() {
    lift();
    lay_palm(false);
    for (std::size_t s = 0; s < ringing_.size(); ++s) release(s);
}

}  // namespace jawari::host::window
