-- Run by ardour.py in Ardour's Lua: a session with a track for each format of the plugin, a note, a parameter, saved and
-- reopened. Prints "KEY VALUE" lines. FOLDER comes from the environment.
local folder = os.getenv("JAWARI_SESSION")
local kinds = {
  {"lv2", "urn:jawari:instrument", ARDOUR.PluginType.LV2},
  {"vst3", "4A6177617269537472696E67456E6731", ARDOUR.PluginType.VST3},
}

-- Calls f(plugin insert, n) for the control called "Palm mute", the n-th of the plugin's controls.
local function with_palm_mute(session, track, f)
  local insert = session:route_by_name(track):nth_plugin(0)
  local plugin = insert:to_insert():plugin(0)
  local n = 0
  for i = 0, plugin:parameter_count() - 1 do
    if plugin:parameter_is_control(i) and plugin:parameter_is_input(i) then
      if plugin:parameter_label(i) == "Palm mute" then f(insert, n) end
      n = n + 1
    end
  end
end

AudioEngine:set_backend("None (Dummy)", "", "")
local session = create_session(folder, "piece", 48000)
assert(session, "no session")
for _, kind in ipairs(kinds) do
  local info = ARDOUR.LuaAPI.new_plugin_info(kind[2], kind[3])
  assert(not info:isnil(), "Ardour does not know the plugin as " .. kind[1])
  session:new_midi_track(ARDOUR.ChanCount(ARDOUR.DataType("midi"), 1), ARDOUR.ChanCount(ARDOUR.DataType("audio"), 2), true, info,
                         nil, nil, 1, kind[1], ARDOUR.PresentationInfo.max_order, ARDOUR.TrackMode.Normal, true)
  with_palm_mute(session, kind[1], function(insert, n) ARDOUR.LuaAPI.set_processor_param(insert, n, 0.25) end)
end
for _, kind in ipairs(kinds) do
  local route = session:route_by_name(kind[1])
  local parser = ARDOUR.RawMidiParser()
  for _, byte in ipairs({0x90, 40, 112}) do
    if parser:process_byte(byte) then
      route:to_track():to_midi_track():write_immediate_event(Evoral.EventType.MIDI_EVENT, parser:buffer_size(), parser:midi_buffer())
    end
  end
  local loudest = -200
  for _ = 1, 20 do
    ARDOUR.LuaAPI.usleep(50000)
    loudest = math.max(loudest, route:peak_meter():meter_level(1, ARDOUR.MeterType.MeterPeak))  -- 0 is the MIDI input's
  end
  print(kind[1] .. "_peak_db", loudest)
end
session:save_state("", false, false, false, false, false)
close_session()

session = load_session(folder, "piece")
assert(session, "the session does not open again")
for _, kind in ipairs(kinds) do
  with_palm_mute(session, kind[1], function(insert, n)
    print(kind[1] .. "_palm_mute", (ARDOUR.LuaAPI.get_processor_param(insert, n, true)))
  end)
end
close_session()
quit()
