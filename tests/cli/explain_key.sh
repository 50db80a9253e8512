# A key, a choice, a section, a map that is no section, a knob, the columns, a key of one contact, keys of designs.
for key in motion.rate motion.points motion.law surface.along surface.grit.density surface.roughness surface.roughness.rms output.level accuracy accuracy.oversampling output.diagnostics.columns \
    contacts.rod.motion.rate contacts include surface.object.thickness scraper.object contact.strike.stiffness output.listen.places accuracy.gain_ramp level length set rasp-design seed designs; do
    rasp explain $key
    echo
done
for word in factor desing "base --json" "design --json"; do rasp explain $word || true; done
