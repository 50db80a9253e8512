/* The version, of which MAJOR.MINOR grows with every change of a sound, and the third number with what leaves sounds as
   they are. Their history: CHANGELOG.md. */
#ifndef BASE_VERSION_H
#define BASE_VERSION_H

#define VERSION "0.2.0"

#endif
