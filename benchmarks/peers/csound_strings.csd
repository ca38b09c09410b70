<CsoundSynthesizer>
<CsOptions>
-n -d -m0
</CsOptions>
<CsInstruments>
; Plucked and struck strings of Csound at 110 Hz. The score picks one; run.py measures it.
sr = 48000
ksmps = 64
nchnls = 1
0dbfs = 1

giRattle ftgen 1, 0, 8, 2, 1, 0.6, 10, 100, 0.001
giRubber ftgen 2, 0, 8, 2, 1, 0.7, 50, 500, 1000

instr prepiano
  aLeft, aRight prepiano 110, 3, 10, 1, 3, 0.002, 2, 2, 1, 5000, -0.01, 0.09, 60, 0, 0.1, 1, 2
  out aLeft * 0.75
endin

instr prepiano_bare
  aLeft, aRight prepiano 110, 1, 10, 1, 3, 0.002, 2, 2, 1, 5000, -0.01, 0.09, 60, 0, 0.1
  out aLeft * 0.75
endin

instr wgpluck2
  aString wgpluck2 0.75, 0.5, 110, 0.75, 0.5
  out aString
endin

instr pluck
  aString pluck 0.5, 110, 110, 0, 1
  out aString
endin
</CsInstruments>
<CsScore>
i "$NAME" 0 $SECONDS
</CsScore>
</CsoundSynthesizer>
