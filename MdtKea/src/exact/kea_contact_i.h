/* Inside Kea: contacts of the exact solver, from manifolds to rows.
 *
 *     kea_contact.c       its rows
 *     kea_flight.c        contacts of bodies that fly
 */
#ifndef KEA_CONTACT_I_H
#define KEA_CONTACT_I_H

#include "common/kea_anchor_i.h"

/* Sets place, depth, and which rows it gets; makes these behind the others. */
void kea_contactChooseRows(const MdtKeaSystem *s, KeaContact *c);
void kea_contactMakeRows(MdtKeaSystem *s, KeaContact *c, int owner);
/* Adds the forces of its rows to its point's. */
void kea_contactAddForces(const MdtKeaSystem *s, const KeaContact *c);

#endif
