/* Inside Kea: contacts of the exact solver, converted from manifolds to rows.
 *
 *     kea_contact.c       rows of a contact
 *     kea_flight.c        uses them for one contact at a time
 */
#ifndef KEA_CONTACT_I_H
#define KEA_CONTACT_I_H

#include "common/kea_anchor_i.h"

/* Sets position, depth, arms and the set of rows of a contact; appends these rows to the system's, for `owner`. */
void kea_contactChooseRows(const MdtKeaSystem *s, KeaContact *c);
void kea_contactMakeRows(MdtKeaSystem *s, KeaContact *c, int owner);
/* Adds the forces of the contact's rows to those of its point. */
void kea_contactAddForces(const MdtKeaSystem *s, const KeaContact *c);

#endif
