#include "window/view/keyboard_panel.h"

#include <algorithm>

#include "window/model/note_names.h"

namespace jawari::host::window {

void KeyboardPanel::place() {
    const auto& instrument = shared_.performance.preset().instrument;
    int lowest = 127;
    int highest = 0;
    has_.fill(false);
    if (instrument != nullptr) {
        for (const InstrumentStringModel& string : instrument->model.strings) {
            for (const StoppedStringModel& stopped : string.stopped) {
                if (stopped.key < 0 || stopped.key > 127) continue;
                has_[static_cast<std::size_t>(stopped.key)] = true;
                lowest = std::min(lowest, stopped.key);
                highest = std::max(highest, stopped.key);
            }
        }
    }
    if (lowest > highest) lowest = highest = 60;
    chosen_ = std::clamp(chosen_, lowest, highest);
    keys_ = piano_keys(shared_.layout.keyboard, lowest, highest);
}

void KeyboardPanel::draw_still(Canvas& canvas) {
    for (const PianoKey& key : keys_) {
        const auto index = static_cast<std::size_t>(key.key);
        const bool sounds = sounds_[index] || down_ == key.key;
        Colour colour = key.black ? theme::ground : theme::quiet;
        if (!has_[index]) colour = key.black ? theme::surface : theme::line;
        if (sounds) colour = theme::accent;
        const Box inside{key.box.x + 0.5F, key.box.y, key.box.width - 1, key.box.height};
        canvas.box(inside, colour, 2);
        if (key.black) canvas.frame(inside, theme::line, 1, 2);
        if (!key.black && has_[index] && key.key % 12 == 0 && key.box.width > 12)
            canvas.text({key.box.x, key.box.bottom() - 16, key.box.width, 14}, note_name(key.key),
                        std::min(theme::small_type, key.box.width * 0.5F), theme::ground, TextPlace::Middle);
        if (shows_focus(0) && key.key == chosen_)
            draw_focus(canvas, {key.box.x + 3, key.box.y + 3, key.box.width - 6, key.box.height - 6});
    }
}

void KeyboardPanel::take(const StagePicture& picture) {
    std::array<bool, 128> sounds{};
    for (std::size_t n = 0; n < picture.note_count; ++n) sounds[picture.notes[n].key & 127U] = true;
    if (sounds == sounds_) return;
    sounds_ = sounds;
    shared_.still_changed = true;
}

void KeyboardPanel::play(int key, double velocity) {
    let_go();
    down_ = key;
    shared_.performance.link().send(note_on(0, key, velocity));
    shared_.performance.wake();
    shared_.still_changed = true;
}

void KeyboardPanel::let_go() {
    if (!down_) return;
    shared_.performance.link().send(note_off(0, *down_));
    shared_.performance.wake();
    down_.reset();
    shared_.still_changed = true;
}

bool KeyboardPanel::press(const Pointer& pointer) {
    if (!shared_.layout.keyboard.has(pointer.x, pointer.y)) return false;
    if (pointer.button == 1) drag(pointer);
    return true;
}

void KeyboardPanel::drag(const Pointer& pointer) {
    const auto key = key_at(keys_, pointer.x, pointer.y);
    if (key == down_) return;
    if (!key) {
        let_go();
        return;
    }
    const auto place =
        std::find_if(keys_.begin(), keys_.end(), [&](const PianoKey& one) { return one.key == *key; });
    play(*key, velocity_at(*place, pointer.y));
}

void KeyboardPanel::release(const Pointer& /*pointer*/) {
    let_go();
}

bool KeyboardPanel::hover(const Pointer& pointer) {
    const auto key = key_at(keys_, pointer.x, pointer.y);
    if (key) shared_.say(note_name(*key) + ": louder towards the front edge");
    return key.has_value();
}

bool KeyboardPanel::key(const KeyPress& press) {
    const int first = keys_.empty() ? 0 : keys_.front().key;
    int last = first;
    for (const PianoKey& key : keys_) last = std::max(last, key.key);
    constexpr double velocity = 0.7;
    switch (press.key) {
        case KeyName::Left:
            chosen_ = std::max(chosen_ - 1, first);
            break;
        case KeyName::Right:
            chosen_ = std::min(chosen_ + 1, last);
            break;
        case KeyName::Enter:
            play(chosen_, velocity);
            return true;
        case KeyName::Delete:
        case KeyName::Escape:
            let_go();
            return true;
        default:
            return false;
    }
    let_go();
    shared_.say(note_name(chosen_));
    shared_.still_changed = true;
    return true;
}

}  // namespace jawari::host::window
