// Malformed and hostile files: one clear failure, no crash, no memory taken on a file's word.
#include <gtest/gtest.h>

#include <random>
#include <string>

#include "formats/midi_file/midi_file.h"
#include "support/midi_bytes.h"

namespace jawari::host {
namespace {

using namespace jawari::test;

std::string failure_of(const Bytes& bytes) {
    const auto file = parse_midi(bytes);
    return file.ok() ? "accepted" : file.failure().line();
}

Bytes one_event_file(const Bytes& event) {
    Bytes track;
    append_event(track, 0, event);
    append_event(track, 0, end_of_track);
    return file_with_track(track);
}

void expect_failure(const Bytes& bytes, const std::string& place, const std::string& part) {
    const std::string line = failure_of(bytes);
    EXPECT_EQ(line.rfind(place + ": ", 0), 0U) << line << "\n  expected to start with: " << place;
    EXPECT_NE(line.find(part), std::string::npos) << line << "\n  expected to contain: " << part;
}

/// Several tracks with every kind of event.
Bytes rich_file() {
    Bytes first, second;
    append_event(first, 0, tempo_event(400000));
    append_event(first, 0, {0xFF, 0x03, 2, 'h', 'i'});
    append_event(first, 200, {0xF0, 3, 1, 2, 0xF7});
    append_event(first, 0, end_of_track);
    append_event(second, 0, {0x90, 40, 100});
    append_event(second, 300, {40, 0});
    append_event(second, 0, {0xC5, 12});
    append_event(second, 20000, {0xE1, 3, 64});
    append_event(second, 0, end_of_track);
    Bytes bytes = header_chunk(1, 2, 96);
    append(bytes, chunk("MTrk", first));
    append(bytes, chunk("MTrk", second));
    return bytes;
}

TEST(MidiMalformed, EachFaultIsNamedWithItsPlace) {
    constexpr std::uint8_t track_start = 22;  // MThd 14 bytes, MTrk and its length 8
    const std::string first_event = "byte " + std::to_string(track_start + 1) + " (track 1)";
    expect_failure({}, "byte 0", "not a standard MIDI file");
    expect_failure({'M', 'T', 'h', 'd', 0, 0, 0}, "byte 4", "header");
    expect_failure({'M', 'T', 'h', 'd', 0xFF, 0xFF, 0xFF, 0xFF, 0, 0}, "byte 4", "4294967295");
    expect_failure(header_chunk(2, 1, 96), "byte 8", "type 2");
    expect_failure(header_chunk(0, 2, 96), "byte 10", "2 tracks");
    expect_failure(header_chunk(1, 0, 96), "byte 10", "0 tracks");
    expect_failure(header_chunk(0, 1, 0), "byte 12", "division 0");
    expect_failure(header_chunk(0, 1, 0xE800), "byte 12", "division");  // 24 frames/s, 0 ticks per frame
    expect_failure(header_chunk(0, 1, 0x8001), "byte 12", "division");  // 128 frames/s
    expect_failure(header_chunk(0, 1, 96), "byte 14", "ends before track 1");
    expect_failure(one_event_file({40, 100}), first_event, "without a status byte");
    expect_failure(one_event_file({0x90, 0x80, 1}), "byte 24 (track 1)", "data byte 0x80");
    expect_failure(one_event_file({0xF4}), first_event, "status byte 0xF4");
    expect_failure(one_event_file({0xFF, 0x51, 2, 1, 1}), "byte 26 (track 1)", "tempo of 2 bytes");
    expect_failure(one_event_file(tempo_event(0)), "byte 26 (track 1)", "tempo of 0");
    expect_failure(one_event_file({0xFF, 0x81, 0}), "byte 24 (track 1)", "meta event type 0x81");
    expect_failure(one_event_file({0xF0, 0xFF, 0xFF, 0xFF, 0x7F}), "byte 28 (track 1)", "268435455 bytes");
    expect_failure(one_event_file({0xF0, 0xFF, 0xFF, 0xFF, 0xFF, 0x01}), "byte 24 (track 1)",
                   "more than 4 bytes");
    expect_failure(file_with_track({0x00, 0x90, 40, 100}), "byte 26 (track 1)", "no End of Track");
    expect_failure(file_with_track({0xFF, 0xFF, 0xFF, 0xFF, 0x7F, 0x90, 40, 100}), "byte 22 (track 1)",
                   "delta time");
    expect_failure(file_with_track({0x00, 0x90, 40}), "byte 25 (track 1)", "ends inside");
    expect_failure({'R', 'I', 'F', 'F', 0, 0, 0, 0, 'W', 'A', 'V', 'E'}, "byte 8", "RIFF");
}

TEST(MidiMalformed, RunningStatusEndsAtMetaAndSystemExclusive) {
    for (const Bytes& between : {Bytes{0xFF, 0x01, 0}, Bytes{0xF0, 1, 0xF7}}) {
        Bytes track;
        append_event(track, 0, {0x90, 40, 100});
        append_event(track, 0, between);
        append_event(track, 0, {40, 0});
        append_event(track, 0, end_of_track);
        EXPECT_NE(failure_of(file_with_track(track)).find("without a status byte"), std::string::npos);
    }
}

TEST(MidiMalformed, HostileLengthsAndTimes) {
    Bytes bytes = header_chunk(1, 65535, 96);
    append_tag(bytes, "MTrk");
    append_big_endian(bytes, 0xFFFFFFFF, 4);
    expect_failure(bytes, "byte 18 (track 1)", "4294967295 bytes");

    Bytes track;
    append_event(track, 0, tempo_event(0xFFFFFF));
    for (int i = 0; i < 1000; ++i) append_event(track, 0x0FFFFFFF, {0x90, 40, 100});
    append_event(track, 0, end_of_track);
    EXPECT_NE(failure_of(file_with_track(track, 1)).find("1000 hours"), std::string::npos);
    EXPECT_NE(failure_of(Bytes(max_midi_file_bytes + 1)).find("at most"), std::string::npos);
}

TEST(MidiMalformed, TruncatedAnywhereIsRefused) {
    const Bytes whole = rich_file();
    ASSERT_EQ(failure_of(whole), "accepted");
    for (std::size_t length = 0; length < whole.size(); ++length) {
        EXPECT_NE(failure_of(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length))),
                  "accepted")
            << length;
    }
}

TEST(MidiMalformed, TruncatedAnywhereIsPlayedAsFarAsItGoes) {
    const Bytes whole = rich_file();
    const auto all = parse_midi(whole).value().events;
    for (std::size_t length = 0; length < whole.size(); ++length) {
        const Bytes cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length));
        const auto file = parse_midi(cut, MidiReading::Lenient);
        EXPECT_EQ(file.ok(), length >= 22) << length;  // the header, and the head of one track
        if (!file.ok()) continue;
        EXPECT_FALSE(file.value().repairs.empty()) << length;
        EXPECT_LE(file.value().events.size(), all.size());
    }
}

/// What a lenient reading makes of the bytes: places and assumptions of its repairs.
std::string repairs_of(const Bytes& bytes) {
    const auto file = parse_midi(bytes, MidiReading::Lenient);
    if (!file) return file.failure().line();
    std::string text = std::to_string(file.value().events.size()) + " events";
    for (const MidiRepair& repair : file.value().repairs) text += "|" + text_of(repair);
    return text;
}

TEST(MidiMalformed, EachRepairIsNamedWithItsPlaceAndWhatWasAssumed) {
    const Bytes on{0, 0x90, 40, 100};
    const auto track = [&](const Bytes& more) {
        Bytes all = on;
        append(all, more);
        return file_with_track(all);
    };
    const auto end = [](Bytes more) {
        append(more, {0, 0xFF, 0x2F, 0});
        return more;
    };
    EXPECT_EQ(repairs_of(track(end({10, 40, 0}))), "2 events");
    EXPECT_EQ(repairs_of(track({})),
              "1 events|byte 26 (track 1): no End of Track; the track ends with its chunk");
    EXPECT_EQ(repairs_of(track({10, 40})),
              "1 events|byte 28 (track 1): the track's chunk ends inside a channel message; the track ends "
              "before it");
    EXPECT_EQ(repairs_of(track(end({10, 0xFF, 0x01, 0, 5, 40, 0}))),
              "2 events|byte 31 (track 1): data byte 0x28 without a status byte before it; the status before "
              "those events goes on");
    EXPECT_EQ(repairs_of(file_with_track(end({0, 40, 100, 0x90, 41, 1}))),
              "1 events|byte 23 (track 1): data byte 0x28 without a status byte before it; data up to the "
              "next status byte are left out");
    EXPECT_EQ(repairs_of(track(end({10, 0x90, 0xA8, 0}))),
              "2 events|byte 28 (track 1): data byte 0xA8; its lower seven bits count");
    EXPECT_EQ(repairs_of(track(end({10, 0xF2, 1, 2, 10, 0xFE, 3, 40, 0}))),
              "2 events|byte 27 (track 1): status byte 0xF2, 2 times; it is left out");
    EXPECT_EQ(repairs_of(track(end({0, 0xFF, 0x51, 3, 0, 0, 0}))),
              "1 events|byte 30 (track 1): tempo of 0 microseconds per quarter note; it is left out");
    EXPECT_EQ(repairs_of(track(end({0, 0xFF, 0x21, 2, 0, 0}))),
              "1 events|byte 30 (track 1): MIDI port of 2 bytes; it is left out");
    EXPECT_EQ(repairs_of(track({0, 0xFF, 0x01, 50, 1})),
              "1 events|byte 30 (track 1): a meta event of 50 bytes; the track ends before it");
    EXPECT_EQ(repairs_of(track({0xFF, 0xFF, 0xFF, 0xFF, 0x7F, 40, 0})),
              "1 events|byte 26 (track 1): a delta time of more than 4 bytes; the track ends before it");
    EXPECT_EQ(repairs_of(track({0, 0xFF, 0x2F, 0, 0, 0})), "1 events");  // padding
    Bytes tail = track(end({}));
    append(tail, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10});
    EXPECT_EQ(repairs_of(tail), "1 events|byte 30: 10 bytes that are no chunk; they are left out");
    Bytes rate = header_chunk(0, 1, 0xF628);  // 10 frames a second
    append(rate, chunk("MTrk", end(on)));
    EXPECT_EQ(repairs_of(rate), "1 events|byte 12: division 63016; 10 frames per second");
    EXPECT_EQ(repairs_of(track(end({0, 0xFF, 0x21, 1, 200}))),
              "1 events|byte 30 (track 1): MIDI port 200; it is left out");
    EXPECT_EQ(repairs_of({0x1F, 0x8B, 8, 0, 0}),
              "byte 0: a file packed by gzip (allowed: a MIDI file; gunzip unpacks it)");
    EXPECT_EQ(repairs_of(header_chunk(1, 1, 96)),
              "byte 14: no track (allowed: a track chunk (MTrk) after the header)");
}

/// A track that plays the key, and ends; its length says `wrong` bytes more.
Bytes track_of_key(std::uint8_t key, int wrong = 0) {
    Bytes whole = chunk("MTrk", {0, 0x90, key, 100, 10, 0x80, key, 0, 0, 0xFF, 0x2F, 0});
    whole[7] = static_cast<std::uint8_t>(whole[7] + wrong);
    return whole;
}

Bytes two_tracks(int type, int announced, int first_is_wrong, int second_is_wrong) {
    Bytes bytes = header_chunk(static_cast<std::uint16_t>(type), static_cast<std::uint16_t>(announced), 96);
    append(bytes, track_of_key(40, first_is_wrong));
    append(bytes, track_of_key(50, second_is_wrong));
    return bytes;
}

TEST(MidiMalformed, NoNoteIsLostToAWrongLength) {
    EXPECT_EQ(repairs_of(two_tracks(1, 2, 0, 0)), "4 events");
    EXPECT_EQ(repairs_of(two_tracks(1, 2, -12, 0)),  // a length of nothing: the writer forgot to fill it in
              "4 events|byte 18 (track 1): chunk of 0 bytes; it goes on to the next track");
    EXPECT_EQ(repairs_of(two_tracks(1, 2, -5, 0)),
              "4 events|byte 18 (track 1): chunk of 7 bytes; it goes on to the next track");
    EXPECT_EQ(repairs_of(two_tracks(1, 2, 0, -6)),
              "4 events|byte 38 (track 2): chunk of 6 bytes; it goes on to the next track");
    EXPECT_EQ(repairs_of(two_tracks(1, 2, 6, 0)),
              "4 events|byte 18 (track 1): chunk of 18 bytes; it ends where the next track begins");
    EXPECT_EQ(repairs_of(two_tracks(1, 2, 100, 0)),
              "4 events|byte 18 (track 1): chunk of 112 bytes; it ends where the next track begins");
    for (const int wrong : {-12, -5, 6, 100}) EXPECT_NE(failure_of(two_tracks(1, 2, wrong, 0)), "accepted");
}

TEST(MidiMalformed, ATrackMoreThanAnnouncedIsPlayedInEveryType) {
    for (const int type : {0, 1})
        EXPECT_EQ(repairs_of(two_tracks(type, 1, 0, 0)),
                  "4 events|byte 10: 1 track announced; all 2 are played")
            << type;
    Bytes joined = header_chunk(0, 1, 96);  // two files, one after the other
    append(joined, track_of_key(40));
    append(joined, header_chunk(0, 1, 96));
    append(joined, track_of_key(50));
    EXPECT_EQ(repairs_of(joined), "4 events|byte 10: 1 track announced; all 2 are played");
}

TEST(MidiMalformed, MusicEndsWithItsLastNoteOrPedal) {
    const auto seconds = [](const Bytes& late) {
        Bytes track{0, 0x90, 40, 100, 96, 0x80, 40, 0};  // a tenth of a second
        append_event(track, 960 * 40, late);             // 40 s later
        append_event(track, 0, end_of_track);
        const auto file = parse_midi(file_with_track(track), MidiReading::Lenient);
        if (!file) return -1.0;
        return static_cast<double>(file.value().end_time) /
               static_cast<double>(file.value().time_units_per_s);
    };
    EXPECT_EQ(seconds({0xB0, 121, 0}), 0.1);
    EXPECT_EQ(seconds({0xF0, 2, 1, 0xF7}), 0.1);
    EXPECT_EQ(seconds({0xC0, 5}), 0.1);
    EXPECT_EQ(seconds({0xB0, 64, 0}), 40.1);
    EXPECT_EQ(seconds({0x80, 41, 0}), 40.1);
}

TEST(MidiMalformed, PatternsOfType2AreOneAfterTheOther) {
    Bytes first, second;
    append_event(first, 0, {0x90, 40, 100});
    append_event(first, 96, {0x80, 40, 100});
    append_event(first, 96, end_of_track);
    append_event(second, 24, {0x90, 41, 100});
    append_event(second, 0, end_of_track);
    Bytes bytes = header_chunk(2, 2, 96);
    append(bytes, chunk("MTrk", first));
    append(bytes, chunk("MTrk", second));
    const auto file = parse_midi(bytes, MidiReading::Lenient);
    ASSERT_TRUE(file.ok());
    ASSERT_EQ(file.value().events.size(), 3U);
    EXPECT_EQ(file.value().events[2].tick, 192U + 24U);
}

TEST(MidiMalformed, DamagedBytesNeverDoHarm) {
    // Whatever the result, events stay ordered and inside their ranges; memory errors are for the sanitizer
    // builds.
    const auto check = [](const Bytes& bytes) {
        for (const MidiReading reading : {MidiReading::Strict, MidiReading::Lenient}) {
            const auto file = parse_midi(bytes, reading);
            if (!file.ok()) {
                EXPECT_FALSE(file.failure().place.empty());
                EXPECT_EQ(file.failure().line().find('\n'), std::string::npos);
                continue;
            }
            std::uint64_t time = 0;
            for (const MidiEvent& e : file.value().events) {
                EXPECT_GE(e.time, time);
                time = e.time;
                EXPECT_TRUE(e.status >= 0x80 && e.status <= 0xF0 && e.data1 < 128 && e.data2 < 128);
                EXPECT_TRUE(e.status < 0xF0 || e.exclusive < file.value().exclusives.size());
            }
            EXPECT_GE(file.value().end_time, time);
        }
    };
    const Bytes whole = rich_file();
    for (std::size_t i = 0; i < whole.size(); ++i) {
        for (int value = 0; value < 256; ++value) {
            Bytes damaged = whole;
            damaged[i] = static_cast<std::uint8_t>(value);
            check(damaged);
        }
    }
    std::mt19937 random(7);
    for (int trial = 0; trial < 20000; ++trial) {
        Bytes damaged = whole;
        for (unsigned n = 0, count = 1 + static_cast<unsigned>(random() % 8); n < count; ++n) {
            damaged[random() % damaged.size()] = static_cast<std::uint8_t>(random());
        }
        check(damaged);
    }
}

}  // namespace
}  // namespace jawari::host
