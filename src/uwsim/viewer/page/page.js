/*! uPlot 1.6.32:
The MIT License (MIT)

Copyright (c) 2022 Leon Sorokin

Permission is hereby granted, free of charge, to any person obtaining a copy
of this software and associated documentation files (the "Software"), to deal
in the Software without restriction, including without limitation the rights
to use, copy, modify, merge, publish, distribute, sublicense, and/or sell
copies of the Software, and to permit persons to whom the Software is
furnished to do so, subject to the following conditions:

The above copyright notice and this permission notice shall be included in
all copies or substantial portions of the Software.

THE SOFTWARE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY KIND, EXPRESS OR
IMPLIED, INCLUDING BUT NOT LIMITED TO THE WARRANTIES OF MERCHANTABILITY,
FITNESS FOR A PARTICULAR PURPOSE AND NONINFRINGEMENT. IN NO EVENT SHALL THE
AUTHORS OR COPYRIGHT HOLDERS BE LIABLE FOR ANY CLAIM, DAMAGES OR OTHER
LIABILITY, WHETHER IN AN ACTION OF CONTRACT, TORT OR OTHERWISE, ARISING FROM,
OUT OF OR IN CONNECTION WITH THE SOFTWARE OR THE USE OR OTHER DEALINGS IN
THE SOFTWARE.*/
"use strict";(()=>{function Ae(i){return Float64Array.from(i)}function Pe(i,e){let t=new Float64Array(16);for(let r=0;r<16;r+=4)for(let s=0;s<4;++s)t[r+s]=i[r]*e[s]+i[r+1]*e[4+s]+i[r+2]*e[8+s]+i[r+3]*e[12+s];return t}function st(i,e=0){let[t,r,s]=[i[e],i[e+1],i[e+2]],n=Math.hypot(i[e+3],i[e+4],i[e+5],i[e+6])||1,[a,o,l,c]=[3,4,5,6].map(d=>i[e+d]/n);return Ae([1-2*(l*l+c*c),2*(o*l-a*c),2*(o*c+a*l),t,2*(o*l+a*c),1-2*(o*o+c*c),2*(l*c-a*o),r,2*(o*c-a*l),2*(l*c+a*o),1-2*(o*o+l*l),s,0,0,0,1])}function ja(i){let t=[[1,1,1],[1,-1,-1],[-1,1,-1],[-1,-1,1]].map(([d,h,m])=>Math.max(0,1+d*i[0]+h*i[5]+m*i[10])),[r,s,n,a]=t.map(d=>Math.sqrt(d)/2),o=t.indexOf(Math.max(...t)),l=[[1,i[9]-i[6],i[2]-i[8],i[4]-i[1]],[i[9]-i[6],1,i[1]+i[4],i[2]+i[8]],[i[2]-i[8],i[1]+i[4],1,i[6]+i[9]],[i[4]-i[1],i[2]+i[8],i[6]+i[9],1]],c=[r,s,n,a].map((d,h)=>d*(l[o][h]<0?-1:1));return[i[3],i[7],i[11],...c]}function ft(i){let e=t=>-(i[t]*i[3]+i[4+t]*i[7]+i[8+t]*i[11]);return Ae([i[0],i[4],i[8],e(0),i[1],i[5],i[9],e(1),i[2],i[6],i[10],e(2),0,0,0,1])}function hn(i){return le([i[0],i[1],i[2]],it([i[4],i[5],i[6]],[i[8],i[9],i[10]]))}function $a(i){let e=[0,4,8].map(a=>[i[a],i[a+1],i[a+2]]),t=1/hn(i),[r,s,n]=[it(e[1],e[2]),it(e[2],e[0]),it(e[0],e[1])];return Ae([...[r,s,n].flatMap(a=>[a[0]*t,a[1]*t,a[2]*t,0]),0,0,0,1])}function Ie(i,e){return[i[0]*e[0]+i[1]*e[1]+i[2]*e[2]+i[3],i[4]*e[0]+i[5]*e[1]+i[6]*e[2]+i[7],i[8]*e[0]+i[9]*e[1]+i[10]*e[2]+i[11]]}function Yr(i,e){return[le([i[0],i[1],i[2]],e),le([i[4],i[5],i[6]],e),le([i[8],i[9],i[10]],e)]}function Vi(i,e){return[le([i[0],i[4],i[8]],e),le([i[1],i[5],i[9]],e),le([i[2],i[6],i[10]],e)]}function ve(i){return[i[3],i[7],i[11]]}function le(i,e){return i[0]*e[0]+i[1]*e[1]+i[2]*e[2]}function it(i,e){return[i[1]*e[2]-i[2]*e[1],i[2]*e[0]-i[0]*e[2],i[0]*e[1]-i[1]*e[0]]}function Me(i,e,t=1){return[i[0]+t*e[0],i[1]+t*e[1],i[2]+t*e[2]]}function bt(i){let e=Math.hypot(i[0],i[1],i[2])||1;return[i[0]/e,i[1]/e,i[2]/e]}function dn(i,e,t=[0,0,1]){let r=bt(Me(i,e,-1)),s=it(t,r);Math.hypot(...s)<1e-6&&(s=it([1,0,0],r)),s=bt(s);let n=it(r,s);return Ae([s[0],n[0],r[0],i[0],s[1],n[1],r[1],i[1],s[2],n[2],r[2],i[2],0,0,0,1])}function Ka(i,e,t){let r=Math.min(e,.75*i)/(2*Math.tan(t/2)),s={cx:(i-1)/2,cy:(e-1)/2};return{width:i,height:e,fx:r,fy:r,...s,skew:0,near:.05,far:2e3}}function hi(i,e){let[t,r]=[Math.round(i.width*e),Math.round(i.height*e)];return{...i,width:t,height:r,fx:i.fx*e,fy:i.fy*e,cx:(i.cx+.5)*e-.5,cy:(i.cy+.5)*e-.5,skew:i.skew*e}}function er(i,e){let{width:t,height:r,near:s,far:n}=i,a=n-s,o=e?1:-1;return Ae([2*i.fx/t,2*i.skew/t,1-(2*i.cx+1)/t,0,0,-2*o*i.fy/r,o*(1-(2*i.cy+1)/r),0,0,0,-(n+s)/a,-2*n*s/a,0,0,-1,0])}function wt(i){return[0,1,2,3].flatMap(e=>[i[e],i[4+e],i[8+e],i[12+e]])}var mn=class{constructor(e,t){this.head=e;this.data=t}head;data;numbers(e){let[t,r,s]=e;switch(s){case"f4":return new Float32Array(this.data,t,r);case"u4":return new Uint32Array(this.data,t,r);case"u2":return new Uint16Array(this.data,t,r);case"i2":return new Int16Array(this.data,t,r);case"i1":return new Int8Array(this.data,t,r);default:return new Uint8Array(this.data,t,r)}}};async function Ja(i){let e=new Blob([i]).stream().pipeThrough(new DecompressionStream("gzip"));return new Response(e).arrayBuffer()}var Qa="0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz!#$%/()*+-;,=.?@^_`{|}~";function Za(i){let e=new Uint8Array(128);for(let s=0;s<Qa.length;++s)e[Qa.charCodeAt(s)]=s;let t=Math.ceil(i.length/5),r=new DataView(new ArrayBuffer(4*t));for(let s=0;s<t;++s){let n=0;for(let a=5*s;a<5*s+5;++a)n=85*n+(a<i.length?e[i.charCodeAt(a)]:84);r.setUint32(4*s,n)}return new Uint8Array(r.buffer,0,i.length-t)}async function di(i){let e=await Ja(i),t=new DataView(e).getUint32(0,!0),r=JSON.parse(new TextDecoder().decode(new Uint8Array(e,4,t)));return new mn(r,e.slice(4+t))}var pn=class{constructor(e,t,r=[]){this.head=e;this.rows=t;this.removals=r}head;rows;removals;get columns(){return 7*this.head.bodies.length+this.head.signals.length}get end(){return this.head.start+Math.max(0,this.head.n-1)/this.head.rate}rowIndex(e){return Math.floor(this.rowPosition(e)+1e-6)}rowPosition(e){return Math.min(Math.max((e-this.head.start)*this.head.rate,0),this.head.n-1)}row(e){let t=this.columns,r=this.rowIndex(e),s=this.rows.slice(r*t,(r+1)*t),n=this.rowPosition(e)-r;if(n<1e-6||r+1>=this.head.n)return s;let a=(r+1)*t;for(let o=0;o<7*this.head.bodies.length;++o)s[o]+=n*(this.rows[a+o]-s[o]);return s}};async function eo(i){let e=new Uint8Array(await Ja(i)),t=e.indexOf(10),r=JSON.parse(new TextDecoder().decode(e.subarray(0,t))),s=r.n,n=7*r.bodies.length+r.signals.length,a=e.subarray(t+1),o=to(a,s,n,l=>{let c=l%7<3?r.length:r.quaternion;return l<7*r.bodies.length?c:r.signals[l-7*r.bodies.length].step});return new pn(r,o,Mu(r,a.subarray(4*s*n)))}function to(i,e,t,r){let s=new Float64Array(e*t);for(let n=0;n<t;++n){let a=r(n),o=0;for(let l=0,c=n*e;l<e;++l,++c){let d=i[c]|i[e*t+c]<<8|i[2*e*t+c]<<16;o=o+(d|i[3*e*t+c]<<24)|0,s[l*t+n]=o===-2147483648?NaN:o*a}}return s}function Mu({sand:i},e){if(!i)return[];let t=to(e,i.n,5,r=>r<2?1:i.grain);return Array.from({length:i.n},(r,s)=>{let[n,a,o,l,c]=t.subarray(5*s,5*s+5);return{row:n,heap:a,position:Number.isNaN(o)?null:[o,l,c]}})}function N(i){let e=document.getElementById(i);if(!e)throw new Error(`the page has no element ${i}`);return e}function q(i,e="",t=""){let r=document.createElement(i);return r.textContent=e,r.className=t,r}function gn(i){return i==="ok"?"ok":i==="lost"||i.includes("error")?"bad":"other"}function gr(i,e){let t=-1;return i.levels.forEach(({trial:r,level:s},n)=>{r===i.trial&&s.start<=e+1e-6&&(t=n)}),t}function ro(i){let e=i.levels.filter(({trial:t})=>t===i.trial);return e.length>0&&e.every(({level:t})=>t.status==="no motion")}var zi=class{constructor(e,t){this.player=e;this.choose=t}player;choose;list=N("levels");current=-2;lastLevel=null;show(e){this.lastLevel!==this.player.levels.at(-1)?.level&&this.fill();let t=gr(this.player,e);if(t===this.current)return;this.current=t,this.list.querySelectorAll("button").forEach((n,a)=>{if(n.setAttribute("aria-current",String(a===t)),a!==t||this.list.contains(document.activeElement))return;let o=n.offsetTop-this.list.offsetTop;(o<this.list.scrollTop||o>this.list.scrollTop+this.list.clientHeight-24)&&(this.list.scrollTop=o-this.list.clientHeight/2)});let r=this.player.levels[t]?.level,s=N("now");s.textContent=r?`${r.label} · ${r.status}`:"",s.className=`badge ${r?gn(r.status):""}`,N("why").textContent=r?.why??"",N("why").title=r?.why??""}mark(e,t){let r=N("marks");r.replaceChildren();let s=n=>`${100*(n-e)/Math.max(t-e,1e-9)}%`;for(let{trial:n,level:a}of this.player.levels){if(n!==this.player.trial)continue;let o=q("i","",gn(a.status));o.style.left=s(a.start),o.style.width=s(e+a.end-a.start),o.title=`${a.label}: ${a.status}`,r.append(o)}}fill(){this.lastLevel=this.player.levels.at(-1)?.level,this.current=-2,N("levels-box").hidden=!this.lastLevel,this.list.replaceChildren(...this.player.levels.map(({level:e},t)=>{let r=q("button");r.append(q("span",e.label),q("span",e.status,gn(e.status))),r.title=e.why??"",r.addEventListener("click",()=>this.choose(t));let s=q("li");return s.append(r),s}))}},Gi=class{bars=[];constructor(e){let t=N("thrusters");for(let r of e.vehicles)for(let s of r.thrusters){let n=q("div"),[a,o,l]=[q("span","","bar"),q("i"),q("output")];a.append(o);let c=e.vehicles.length>1?`${r.name} ${s}`:s;n.append(q("span",c.replaceAll("_"," ")),a,l),t.append(n),this.bars.push({signal:`thrust/${r.name}/${s}`,bar:o,value:l})}}show(e){let t=!1;for(let{signal:r,bar:s,value:n}of this.bars){let a=e.signal(r);if(a===void 0)continue;t=!0;let o=50*Math.min(1,Math.abs(a));s.style.left=`${a<0?50-o:50}%`,s.style.width=`${o}%`,n.textContent=`${Math.round(100*a)||0} %`}N("thrusters-box").hidden=!t}};function io(i){let e=N("help");e.replaceChildren();let[t,r]=[q("div","","rows"),q("div","","columns")];t.tabIndex=0,t.append(r),e.append(t);for(let[n,a]of Object.entries(i)){let o=q("dl");for(let c of a)o.append(q("dt",c.keys),q("dd",c.action));let l=q("section");l.append(q("h2",n),o),r.append(l)}let s=q("button","Close");s.addEventListener("click",()=>e.close()),e.append(s)}function Bi(){let i=N("help");i.open?i.close():i.showModal()}var Tu=100,Ru=33,Lu=["left","right"],so={surge:["forward","back"],sway:["right","left"],heave:["up","down"],yaw:["turn right","left"],roll:["roll right","left"],pitch:["pitch up","down"],lamps:["lamps brighter","darker"]},Pu={yaw:"turn",sway:"left / right"},Iu=6e3,Hi=class{constructor(e){this.send=e;document.addEventListener("keyup",t=>{this.pressedKeys.delete(t.key.toLowerCase()),this.poll()}),window.addEventListener("blur",()=>{this.pressedKeys.clear(),this.poll()}),setInterval(()=>this.poll(),Ru)}send;isOn=!1;mapping={};reason="";names={};reservedKeys=new Set;layout="";pressedKeys=new Set;sticks=[0,0,0,0];lastText="";sendTime=0;enable(e){this.isOn=e.pilot,this.mapping=e.pilot?e.mapping:{},this.reservedKeys=new Set(e.reserved),[this.names,this.reason]=[e.names,e.why];let t=JSON.stringify([e.pilot,e.sticks,e.names,e.why]);if(t===this.layout)return;this.layout=t;let s=[...Lu.map((n,a)=>this.stick(n,2*a,e.sticks.slice(2*a,2*a+2))).filter(n=>n!==null),this.reason?q("p",this.reason,"why"):this.keyHints()];N("pilot").replaceChildren(...s.filter(n=>n!==null)),N("pilot").hidden=!e.pilot}isReserved(e){return this.isOn&&this.reservedKeys.has(e)}handlePilotKey(e){let t=e.key.toLowerCase();return e.shiftKey||!this.isReserved(t)?!1:(e.preventDefault(),t in this.mapping&&(this.pressedKeys.add(t),this.poll(),this.hideKeyHints()),!0)}help(){let e=this.keyPairs();return e.length?[...e.map(({axes:r,plusKeys:s,minusKeys:n})=>({keys:`${s||"–"}  ${n||"–"}`,action:`${this.namesOf(r)} +, −`})),{keys:"Shift",action:"with a letter: the page's own key"}]:[{keys:"–",action:this.reason||"this simulation has no pilot"}]}keyPairs(){let e=new Map;for(let[t,r]of Object.entries(this.mapping)){if(!r.trim())continue;let[s,n]=no(r),a=e.get(s)??["",""];a[n]+=(a[n]&&", ")+t,e.set(s,a)}return[...e].map(([t,[r,s]])=>({axes:t,plusKeys:r,minusKeys:s}))}namesOf(e){return e.split(" ").map(t=>{let r=this.names[t.replace("-","")];return r?t.replace(/[a-z]+\d*/,r):t}).join(" ")}keyHints(){let e=this.keyPairs();if(!e.length)return null;let t=q("div","","keyline");for(let{axes:n,plusKeys:a,minusKeys:o}of e){let l=q("span"),c=so[n]?.join(" / ")??this.namesOf(n);for(let d of[a,o])d&&l.append(q("kbd",d.toUpperCase()));l.append(` ${c}`),t.append(l)}let r=q("span");r.append(q("kbd","?")," all keys");let s=q("button","×");return s.setAttribute("aria-label","Hide the line of keys"),s.addEventListener("click",()=>t.remove()),t.append(r,s),t}hideKeyHints(){let e=N("pilot").querySelector(".keyline");e&&!e.classList.contains("leaves")&&(e.classList.add("leaves"),setTimeout(()=>e.remove(),Iu))}input(){let e=navigator.getGamepads?.().find(t=>t!==null);return{keys:[...this.pressedKeys].sort(),axes:e?e.axes.map(vn):[],buttons:e?e.buttons.map(({value:t})=>vn(t)):[],sticks:this.sticks.map(vn)}}poll(){if(!this.isOn)return;let e=this.input(),t=JSON.stringify(e),r=performance.now(),s=!e.keys.length&&![...e.axes,...e.buttons,...e.sticks].some(Boolean);if(t===this.lastText&&(s||r-this.sendTime<Tu))return;let n=t!==this.lastText;this.lastText=t,this.sendTime=r,this.send({type:"input",...e},n)}stick(e,t,r){if(!r.some(h=>h.trim()))return null;let[s,n]=[q("div","",`thumb ${e}`),q("div","","label")],a=["↔","↕"];r.forEach((h,m)=>{h.trim()&&n.prepend(q("span",`${a[m]} ${this.stickWords(h)}`))});let[o,l]=[q("div","","stick"),q("i")];o.title=n.innerText,o.append(l),s.append(n,o);let c=(h,m)=>{let v=Math.max(1,Math.hypot(h,m));this.sticks[t]=h/v,this.sticks[t+1]=m/v,l.style.transform=`translate(${35*h/v}px, ${-35*m/v}px)`,this.poll()},d=h=>{if(!o.hasPointerCapture(h.pointerId))return;let m=o.getBoundingClientRect(),v=m.width/2;c((h.clientX-m.left-v)/v,-(h.clientY-m.top-v)/v)};o.addEventListener("pointerdown",h=>{o.setPointerCapture(h.pointerId),d(h)}),o.addEventListener("pointermove",d);for(let h of["pointerup","pointercancel"])o.addEventListener(h,()=>c(0,0));return s}stickWords(e){let[t]=no(e);return Pu[t]??so[t]?.join(" / ")??this.namesOf(t)}};function no(i){let e=i.trim().split(/\s+/),t=e[0].startsWith("-");return[e.map(s=>(s.startsWith("-")!==t?"-":"")+s.replace(/^[+-]+/,"")).join(" "),t?1:0]}function vn(i){return Math.round(i*1e3)/1e3}var ku="uplot",Fu="u-hz",Cu="u-vt",Ou="u-title",Nu="u-wrap",Du="u-under",Uu="u-over",Vu="u-axis",yr="u-off",zu="u-select",Gu="u-cursor-x",Bu="u-cursor-y",Hu="u-cursor-pt",Wu="u-legend",Yu="u-live",Xu="u-inline",qu="u-series",ju="u-marker",ao="u-label",$u="u-value",pi="width",gi="height";var oo="bottom",Xr="left",_n="right",On="#000",lo=On+"0",yn="mousemove",co="mousedown",bn="mouseup",fo="mouseenter",uo="mouseleave",ho="dblclick",Ku="resize",Qu="scroll",mo="change",ji="dppxchange",Nn="--",Zr=typeof window<"u",An=Zr?document:null,jr=Zr?window:null,Ju=Zr?navigator:null,ce,Wi;function Mn(){let i=devicePixelRatio;ce!=i&&(ce=i,Wi&&Rn(mo,Wi,Mn),Wi=matchMedia(`(min-resolution: ${ce-.001}dppx) and (max-resolution: ${ce+.001}dppx)`),br(mo,Wi,Mn),jr.dispatchEvent(new CustomEvent(ji)))}function ut(i,e){if(e!=null){let t=i.classList;!t.contains(e)&&t.add(e)}}function Tn(i,e){let t=i.classList;t.contains(e)&&t.remove(e)}function we(i,e,t){i.style[e]=t+"px"}function Pt(i,e,t,r){let s=An.createElement(i);return e!=null&&ut(s,e),t?.insertBefore(s,r),s}function xt(i,e){return Pt("div",i,e)}var po=new WeakMap;function Gt(i,e,t,r,s){let n="translate("+e+"px,"+t+"px)",a=po.get(i);n!=a&&(i.style.transform=n,po.set(i,n),e<0||t<0||e>r||t>s?ut(i,yr):Tn(i,yr))}var go=new WeakMap;function vo(i,e,t){let r=e+t,s=go.get(i);r!=s&&(go.set(i,r),i.style.background=e,i.style.borderColor=t)}var _o=new WeakMap;function yo(i,e,t,r){let s=e+""+t,n=_o.get(i);s!=n&&(_o.set(i,s),i.style.height=t+"px",i.style.width=e+"px",i.style.marginLeft=r?-e/2+"px":0,i.style.marginTop=r?-t/2+"px":0)}var Dn={passive:!0},Zu={...Dn,capture:!0};function br(i,e,t,r){e.addEventListener(i,t,r?Zu:Dn)}function Rn(i,e,t,r){e.removeEventListener(i,t,Dn)}Zr&&Mn();function It(i,e,t,r){let s;t=t||0,r=r||e.length-1;let n=r<=2147483647;for(;r-t>1;)s=n?t+r>>1:ht((t+r)/2),e[s]<i?t=s:r=s;return i-e[t]<=e[r]-i?t:r}function qo(i){return(t,r,s)=>{let n=-1,a=-1;for(let o=r;o<=s;o++)if(i(t[o])){n=o;break}for(let o=s;o>=r;o--)if(i(t[o])){a=o;break}return[n,a]}}var jo=i=>i!=null,$o=i=>i!=null&&i>0,Qi=qo(jo),eh=qo($o);function th(i,e,t,r=0,s=!1){let n=s?eh:Qi,a=s?$o:jo;[e,t]=n(i,e,t);let o=i[e],l=i[e];if(e>-1)if(r==1)o=i[e],l=i[t];else if(r==-1)o=i[t],l=i[e];else for(let c=e;c<=t;c++){let d=i[c];a(d)&&(d<o?o=d:d>l&&(l=d))}return[o??me,l??-me]}function Ji(i,e,t,r){let s=xo(i),n=xo(e);i==e&&(s==-1?(i*=t,e/=t):(i/=t,e*=t));let a=t==10?Yt:Ko,o=s==1?ht:Et,l=n==1?Et:ht,c=o(a(De(i))),d=l(a(De(e))),h=$r(t,c),m=$r(t,d);return t==10&&(c<0&&(h=pe(h,-c)),d<0&&(m=pe(m,-d))),r||t==2?(i=h*s,e=m*n):(i=el(i,h),e=Zi(e,m)),[i,e]}function Un(i,e,t,r){let s=Ji(i,e,t,r);return i==0&&(s[0]=0),e==0&&(s[1]=0),s}var Vn=.1,bo={mode:3,pad:Vn},_i={pad:0,soft:null,mode:0},rh={min:_i,max:_i};function $i(i,e,t,r){return es(t)?wo(i,e,t):(_i.pad=t,_i.soft=r?0:null,_i.mode=r?3:0,wo(i,e,rh))}function ae(i,e){return i??e}function ih(i,e,t){for(e=ae(e,0),t=ae(t,i.length-1);e<=t;){if(i[e]!=null)return!0;e++}return!1}function wo(i,e,t){let r=t.min,s=t.max,n=ae(r.pad,0),a=ae(s.pad,0),o=ae(r.hard,-me),l=ae(s.hard,me),c=ae(r.soft,me),d=ae(s.soft,-me),h=ae(r.mode,0),m=ae(s.mode,0),v=e-i,y=Yt(v),w=Ze(De(i),De(e)),x=Yt(w),S=De(x-y);(v<1e-24||S>10)&&(v=0,(i==0||e==0)&&(v=1e-24,h==2&&c!=me&&(n=0),m==2&&d!=-me&&(a=0)));let E=v||w||1e3,T=Yt(E),A=$r(10,ht(T)),G=E*(v==0?i==0?.1:1:n),I=pe(el(i-G,A/10),24),D=i>=c&&(h==1||h==3&&I<=c||h==2&&I>=c)?c:me,U=Ze(o,I<D&&i>=D?D:kt(D,I)),Y=E*(v==0?e==0?.1:1:a),X=pe(Zi(e+Y,A/10),24),P=e<=d&&(m==1||m==3&&X>=d||m==2&&X<=d)?d:-me,K=kt(l,X>P&&e<=P?P:Ze(P,X));return U==K&&U==0&&(K=100),[U,K]}var sh=new Intl.NumberFormat(Zr?Ju.language:"en-US"),zn=i=>sh.format(i),dt=Math,qi=dt.PI,De=dt.abs,ht=dt.floor,Ne=dt.round,Et=dt.ceil,kt=dt.min,Ze=dt.max,$r=dt.pow,xo=dt.sign,Yt=dt.log10,Ko=dt.log2,nh=(i,e=1)=>dt.sinh(i)*e,wn=(i,e=1)=>dt.asinh(i/e),me=1/0;function Eo(i){return(Yt((i^i>>31)-(i>>31))|0)+1}function Ln(i,e,t){return kt(Ze(i,e),t)}function Qo(i){return typeof i=="function"}function ie(i){return Qo(i)?i:()=>i}var ah=()=>{},Jo=i=>i,Zo=(i,e)=>e,oh=i=>null,So=i=>!0,Ao=(i,e)=>i==e,lh=/\.\d*?(?=9{6,}|0{6,})/gm,wr=i=>{if(rl(i)||rr.has(i))return i;let e=`${i}`,t=e.match(lh);if(t==null)return i;let r=t[0].length-1;if(e.indexOf("e-")!=-1){let[s,n]=e.split("e");return+`${wr(s)}e${n}`}return pe(i,r)};function vr(i,e){return wr(pe(wr(i/e))*e)}function Zi(i,e){return wr(Et(wr(i/e))*e)}function el(i,e){return wr(ht(wr(i/e))*e)}function pe(i,e=0){if(rl(i))return i;let t=10**e,r=i*t*(1+Number.EPSILON);return Ne(r)/t}var rr=new Map;function tl(i){return((""+i).split(".")[1]||"").length}function bi(i,e,t,r){let s=[],n=r.map(tl);for(let a=e;a<t;a++){let o=De(a),l=pe($r(i,a),o);for(let c=0;c<r.length;c++){let d=i==10?+`${r[c]}e${a}`:r[c]*l,h=(a>=0?0:o)+(a>=n[c]?0:n[c]),m=i==10?d:pe(d,h);s.push(m),rr.set(m,h)}}return s}var yi={},Gn=[],Kr=[null,null],tr=Array.isArray,rl=Number.isInteger,ch=i=>i===void 0;function Mo(i){return typeof i=="string"}function es(i){let e=!1;if(i!=null){let t=i.constructor;e=t==null||t==Object}return e}function fh(i){return i!=null&&typeof i=="object"}var uh=Object.getPrototypeOf(Uint8Array),il="__proto__";function Qr(i,e=es){let t;if(tr(i)){let r=i.find(s=>s!=null);if(tr(r)||e(r)){t=Array(i.length);for(let s=0;s<i.length;s++)t[s]=Qr(i[s],e)}else t=i.slice()}else if(i instanceof uh)t=i.slice();else if(e(i)){t={};for(let r in i)r!=il&&(t[r]=Qr(i[r],e))}else t=i;return t}function Fe(i){let e=arguments;for(let t=1;t<e.length;t++){let r=e[t];for(let s in r)s!=il&&(es(i[s])?Fe(i[s],Qr(r[s])):i[s]=Qr(r[s]))}return i}var hh=0,dh=1,mh=2;function ph(i,e,t){for(let r=0,s,n=-1;r<e.length;r++){let a=e[r];if(a>n){for(s=a-1;s>=0&&i[s]==null;)i[s--]=null;for(s=a+1;s<t&&i[s]==null;)i[n=s++]=null}}}function gh(i,e){if(yh(i)){let a=i[0].slice();for(let o=1;o<i.length;o++)a.push(...i[o].slice(1));return bh(a[0])||(a=_h(a)),a}let t=new Set;for(let a=0;a<i.length;a++){let l=i[a][0],c=l.length;for(let d=0;d<c;d++)t.add(l[d])}let r=[Array.from(t).sort((a,o)=>a-o)],s=r[0].length,n=new Map;for(let a=0;a<s;a++)n.set(r[0][a],a);for(let a=0;a<i.length;a++){let o=i[a],l=o[0];for(let c=1;c<o.length;c++){let d=o[c],h=Array(s).fill(void 0),m=e?e[a][c]:dh,v=[];for(let y=0;y<d.length;y++){let w=d[y],x=n.get(l[y]);w===null?m!=hh&&(h[x]=w,m==mh&&v.push(x)):h[x]=w}ph(h,v,s),r.push(h)}}return r}var vh=typeof queueMicrotask>"u"?i=>Promise.resolve().then(i):queueMicrotask;function _h(i){let e=i[0],t=e.length,r=Array(t);for(let n=0;n<r.length;n++)r[n]=n;r.sort((n,a)=>e[n]-e[a]);let s=[];for(let n=0;n<i.length;n++){let a=i[n],o=Array(t);for(let l=0;l<t;l++)o[l]=a[r[l]];s.push(o)}return s}function yh(i){let e=i[0][0],t=e.length;for(let r=1;r<i.length;r++){let s=i[r][0];if(s.length!=t)return!1;if(s!=e){for(let n=0;n<t;n++)if(s[n]!=e[n])return!1}}return!0}function bh(i,e=100){let t=i.length;if(t<=1)return!0;let r=0,s=t-1;for(;r<=s&&i[r]==null;)r++;for(;s>=r&&i[s]==null;)s--;if(s<=r)return!0;let n=Ze(1,ht((s-r+1)/e));for(let a=i[r],o=r+n;o<=s;o+=n){let l=i[o];if(l!=null){if(l<=a)return!1;a=l}}return!0}var sl=["January","February","March","April","May","June","July","August","September","October","November","December"],nl=["Sunday","Monday","Tuesday","Wednesday","Thursday","Friday","Saturday"];function al(i){return i.slice(0,3)}var wh=nl.map(al),xh=sl.map(al),Eh={MMMM:sl,MMM:xh,WWWW:nl,WWW:wh};function mi(i){return(i<10?"0":"")+i}function Sh(i){return(i<10?"00":i<100?"0":"")+i}var Ah={YYYY:i=>i.getFullYear(),YY:i=>(i.getFullYear()+"").slice(2),MMMM:(i,e)=>e.MMMM[i.getMonth()],MMM:(i,e)=>e.MMM[i.getMonth()],MM:i=>mi(i.getMonth()+1),M:i=>i.getMonth()+1,DD:i=>mi(i.getDate()),D:i=>i.getDate(),WWWW:(i,e)=>e.WWWW[i.getDay()],WWW:(i,e)=>e.WWW[i.getDay()],HH:i=>mi(i.getHours()),H:i=>i.getHours(),h:i=>{let e=i.getHours();return e==0?12:e>12?e-12:e},AA:i=>i.getHours()>=12?"PM":"AM",aa:i=>i.getHours()>=12?"pm":"am",a:i=>i.getHours()>=12?"p":"a",mm:i=>mi(i.getMinutes()),m:i=>i.getMinutes(),ss:i=>mi(i.getSeconds()),s:i=>i.getSeconds(),fff:i=>Sh(i.getMilliseconds())};function Bn(i,e){e=e||Eh;let t=[],r=/\{([a-z]+)\}|[^{]+/gi,s;for(;s=r.exec(i);)t.push(s[0][0]=="{"?Ah[s[1]]:s[0]);return n=>{let a="";for(let o=0;o<t.length;o++)a+=typeof t[o]=="string"?t[o]:t[o](n,e);return a}}var Mh=new Intl.DateTimeFormat().resolvedOptions().timeZone;function Th(i,e){let t;return e=="UTC"||e=="Etc/UTC"?t=new Date(+i+i.getTimezoneOffset()*6e4):e==Mh?t=i:(t=new Date(i.toLocaleString("en-US",{timeZone:e})),t.setMilliseconds(i.getMilliseconds())),t}var ol=i=>i%1==0,Ki=[1,2,2.5,5],Rh=bi(10,-32,0,Ki),ll=bi(10,0,32,Ki),Lh=ll.filter(ol),_r=Rh.concat(ll),Hn=`
`,cl="{YYYY}",To=Hn+cl,fl="{M}/{D}",vi=Hn+fl,Yi=vi+"/{YY}",ul="{aa}",Ph="{h}:{mm}",qr=Ph+ul,Ro=Hn+qr,Lo=":{ss}",ue=null;function hl(i){let e=i*1e3,t=e*60,r=t*60,s=r*24,n=s*30,a=s*365,l=(i==1?bi(10,0,3,Ki).filter(ol):bi(10,-3,0,Ki)).concat([e,e*5,e*10,e*15,e*30,t,t*5,t*10,t*15,t*30,r,r*2,r*3,r*4,r*6,r*8,r*12,s,s*2,s*3,s*4,s*5,s*6,s*7,s*8,s*9,s*10,s*15,n,n*2,n*3,n*4,n*6,a,a*2,a*5,a*10,a*25,a*50,a*100]),c=[[a,cl,ue,ue,ue,ue,ue,ue,1],[s*28,"{MMM}",To,ue,ue,ue,ue,ue,1],[s,fl,To,ue,ue,ue,ue,ue,1],[r,"{h}"+ul,Yi,ue,vi,ue,ue,ue,1],[t,qr,Yi,ue,vi,ue,ue,ue,1],[e,Lo,Yi+" "+qr,ue,vi+" "+qr,ue,Ro,ue,1],[i,Lo+".{fff}",Yi+" "+qr,ue,vi+" "+qr,ue,Ro,ue,1]];function d(h){return(m,v,y,w,x,S)=>{let E=[],T=x>=a,A=x>=n&&x<a,G=h(y),I=pe(G*i,3),D=xn(G.getFullYear(),T?0:G.getMonth(),A||T?1:G.getDate()),U=pe(D*i,3);if(A||T){let Y=A?x/n:0,X=T?x/a:0,P=I==U?I:pe(xn(D.getFullYear()+X,D.getMonth()+Y,1)*i,3),K=new Date(Ne(P/i)),V=K.getFullYear(),j=K.getMonth();for(let z=0;P<=w;z++){let J=xn(V+X*z,j+Y*z,1),W=J-h(pe(J*i,3));P=pe((+J+W)*i,3),P<=w&&E.push(P)}}else{let Y=x>=s?s:x,X=ht(y)-ht(I),P=U+X+Zi(I-U,Y);E.push(P);let K=h(P),V=K.getHours()+K.getMinutes()/t+K.getSeconds()/r,j=x/r,z=m.axes[v]._space,J=S/z;for(;P=pe(P+x,i==1?0:3),!(P>w);)if(j>1){let W=ht(pe(V+j,6))%24,se=h(P).getHours()-W;se>1&&(se=-1),P-=se*r,V=(V+j)%24;let he=E[E.length-1];pe((P-he)/x,3)*J>=.7&&E.push(P)}else E.push(P)}return E}}return[l,c,d]}var[Ih,kh,Fh]=hl(1),[Ch,Oh,Nh]=hl(.001);bi(2,-53,53,[1]);function Po(i,e){return i.map(t=>t.map((r,s)=>s==0||s==8||r==null?r:e(s==1||t[8]==0?r:t[1]+r)))}function Io(i,e){return(t,r,s,n,a)=>{let o=e.find(y=>a>=y[0])||e[e.length-1],l,c,d,h,m,v;return r.map(y=>{let w=i(y),x=w.getFullYear(),S=w.getMonth(),E=w.getDate(),T=w.getHours(),A=w.getMinutes(),G=w.getSeconds(),I=x!=l&&o[2]||S!=c&&o[3]||E!=d&&o[4]||T!=h&&o[5]||A!=m&&o[6]||G!=v&&o[7]||o[1];return l=x,c=S,d=E,h=T,m=A,v=G,I(w)})}}function Dh(i,e){let t=Bn(e);return(r,s,n,a,o)=>s.map(l=>t(i(l)))}function xn(i,e,t){return new Date(i,e,t)}function ko(i,e){return e(i)}var Uh="{YYYY}-{MM}-{DD} {h}:{mm}{aa}";function Fo(i,e){return(t,r,s,n)=>n==null?Nn:e(i(r))}function Vh(i,e){let t=i.series[e];return t.width?t.stroke(i,e):t.points.width?t.points.stroke(i,e):null}function zh(i,e){return i.series[e].fill(i,e)}var Gh={show:!0,live:!0,isolate:!1,mount:ah,markers:{show:!0,width:2,stroke:Vh,fill:zh,dash:"solid"},idx:null,idxs:null,values:[]};function Bh(i,e){let t=i.cursor.points,r=xt(),s=t.size(i,e);we(r,pi,s),we(r,gi,s);let n=s/-2;we(r,"marginLeft",n),we(r,"marginTop",n);let a=t.width(i,e,s);return a&&we(r,"borderWidth",a),r}function Hh(i,e){let t=i.series[e].points;return t._fill||t._stroke}function Wh(i,e){let t=i.series[e].points;return t._stroke||t._fill}function Yh(i,e){return i.series[e].points.size}var En=[0,0];function Xh(i,e,t){return En[0]=e,En[1]=t,En}function Xi(i,e,t,r=!0){return s=>{s.button==0&&(!r||s.target==e)&&t(s)}}function Sn(i,e,t,r=!0){return s=>{(!r||s.target==e)&&t(s)}}var qh={show:!0,x:!0,y:!0,lock:!1,move:Xh,points:{one:!1,show:Bh,size:Yh,width:0,stroke:Wh,fill:Hh},bind:{mousedown:Xi,mouseup:Xi,click:Xi,dblclick:Xi,mousemove:Sn,mouseleave:Sn,mouseenter:Sn},drag:{setScale:!0,x:!0,y:!1,dist:0,uni:null,click:(i,e)=>{e.stopPropagation(),e.stopImmediatePropagation()},_x:!1,_y:!1},focus:{dist:(i,e,t,r,s)=>r-s,prox:-1,bias:0},hover:{skip:[void 0],prox:null,bias:0},left:-10,top:-10,idx:null,dataIdx:null,idxs:null,event:null},dl={show:!0,stroke:"rgba(0,0,0,0.07)",width:2},Wn=Fe({},dl,{filter:Zo}),ml=Fe({},Wn,{size:10}),pl=Fe({},dl,{show:!1}),Yn='12px system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", Arial, "Noto Sans", sans-serif, "Apple Color Emoji", "Segoe UI Emoji", "Segoe UI Symbol", "Noto Color Emoji"',gl="bold "+Yn,vl=1.5,Co={show:!0,scale:"x",stroke:On,space:50,gap:5,alignTo:1,size:50,labelGap:0,labelSize:30,labelFont:gl,side:2,grid:Wn,ticks:ml,border:pl,font:Yn,lineGap:vl,rotate:0},jh="Value",$h="Time",Oo={show:!0,scale:"x",auto:!1,sorted:1,min:me,max:-me,idxs:[]};function Kh(i,e,t,r,s){return e.map(n=>n==null?"":zn(n))}function Qh(i,e,t,r,s,n,a){let o=[],l=rr.get(s)||0;t=a?t:pe(Zi(t,s),l);for(let c=t;c<=r;c=pe(c+s,l))o.push(Object.is(c,-0)?0:c);return o}function Pn(i,e,t,r,s,n,a){let o=[],l=i.scales[i.axes[e].scale].log,c=l==10?Yt:Ko,d=ht(c(t));s=$r(l,d),l==10&&(s=_r[It(s,_r)]);let h=t,m=s*l;l==10&&(m=_r[It(m,_r)]);do o.push(h),h=h+s,l==10&&!rr.has(h)&&(h=pe(h,rr.get(s))),h>=m&&(s=h,m=s*l,l==10&&(m=_r[It(m,_r)]));while(h<=r);return o}function Jh(i,e,t,r,s,n,a){let l=i.scales[i.axes[e].scale].asinh,c=r>l?Pn(i,e,Ze(l,t),r,s):[l],d=r>=0&&t<=0?[0]:[];return(t<-l?Pn(i,e,Ze(l,-r),-t,s):[l]).reverse().map(m=>-m).concat(d,c)}var _l=/./,Zh=/[12357]/,ed=/[125]/,No=/1/,In=(i,e,t,r)=>i.map((s,n)=>e==4&&s==0||n%r==0&&t.test(s.toExponential()[s<0?1:0])?s:null);function td(i,e,t,r,s){let n=i.axes[t],a=n.scale,o=i.scales[a],l=i.valToPos,c=n._space,d=l(10,a),h=l(9,a)-d>=c?_l:l(7,a)-d>=c?Zh:l(5,a)-d>=c?ed:No;if(h==No){let m=De(l(1,a)-d);if(m<c)return In(e.slice().reverse(),o.distr,h,Et(c/m)).reverse()}return In(e,o.distr,h,1)}function rd(i,e,t,r,s){let n=i.axes[t],a=n.scale,o=n._space,l=i.valToPos,c=De(l(1,a)-l(2,a));return c<o?In(e.slice().reverse(),3,_l,Et(o/c)).reverse():e}function id(i,e,t,r){return r==null?Nn:e==null?"":zn(e)}var Do={show:!0,scale:"y",stroke:On,space:30,gap:5,alignTo:1,size:50,labelGap:0,labelSize:30,labelFont:gl,side:3,grid:Wn,ticks:ml,border:pl,font:Yn,lineGap:vl,rotate:0};function sd(i,e){let t=3+(i||1)*2;return pe(t*e,3)}function nd(i,e){let{scale:t,idxs:r}=i.series[0],s=i._data[0],n=i.valToPos(s[r[0]],t,!0),a=i.valToPos(s[r[1]],t,!0),o=De(a-n),l=i.series[e],c=o/(l.points.space*ce);return r[1]-r[0]<=c}var Uo={scale:null,auto:!0,sorted:0,min:me,max:-me},yl=(i,e,t,r,s)=>s,Vo={show:!0,auto:!0,sorted:0,gaps:yl,alpha:1,facets:[Fe({},Uo,{scale:"x"}),Fe({},Uo,{scale:"y"})]},zo={scale:"y",auto:!0,sorted:0,show:!0,spanGaps:!1,gaps:yl,alpha:1,points:{show:nd,filter:null},values:null,min:me,max:-me,idxs:[],path:null,clip:null};function ad(i,e,t,r,s){return t/10}var bl={time:!0,auto:!0,distr:1,log:10,asinh:1,min:null,max:null,dir:1,ori:0},od=Fe({},bl,{time:!1,ori:1}),Go={};function wl(i,e){let t=Go[i];return t||(t={key:i,plots:[],sub(r){t.plots.push(r)},unsub(r){t.plots=t.plots.filter(s=>s!=r)},pub(r,s,n,a,o,l,c){for(let d=0;d<t.plots.length;d++)t.plots[d]!=s&&t.plots[d].pub(r,s,n,a,o,l,c)}},i!=null&&(Go[i]=t)),t}var Jr=1,kn=2;function xr(i,e,t){let r=i.mode,s=i.series[e],n=r==2?i._data[e]:i._data,a=i.scales,o=i.bbox,l=n[0],c=r==2?n[1]:n[e],d=r==2?a[s.facets[0].scale]:a[i.series[0].scale],h=r==2?a[s.facets[1].scale]:a[s.scale],m=o.left,v=o.top,y=o.width,w=o.height,x=i.valToPosH,S=i.valToPosV;return d.ori==0?t(s,l,c,d,h,x,S,m,v,y,w,rs,ei,ss,El,Al):t(s,l,c,d,h,S,x,v,m,w,y,is,ti,jn,Sl,Ml)}function Xn(i,e){let t=0,r=0,s=ae(i.bands,Gn);for(let n=0;n<s.length;n++){let a=s[n];a.series[0]==e?t=a.dir:a.series[1]==e&&(a.dir==1?r|=1:r|=2)}return[t,r==1?-1:r==2?1:r==3?2:0]}function ld(i,e,t,r,s){let n=i.mode,a=i.series[e],o=n==2?a.facets[1].scale:a.scale,l=i.scales[o];return s==-1?l.min:s==1?l.max:l.distr==3?l.dir==1?l.min:l.max:0}function Xt(i,e,t,r,s,n){return xr(i,e,(a,o,l,c,d,h,m,v,y,w,x)=>{let S=a.pxRound,E=c.dir*(c.ori==0?1:-1),T=c.ori==0?ei:ti,A,G;E==1?(A=t,G=r):(A=r,G=t);let I=S(h(o[A],c,w,v)),D=S(m(l[A],d,x,y)),U=S(h(o[G],c,w,v)),Y=S(m(n==1?d.max:d.min,d,x,y)),X=new Path2D(s);return T(X,U,Y),T(X,I,Y),T(X,I,D),X})}function ts(i,e,t,r,s,n){let a=null;if(i.length>0){a=new Path2D;let o=e==0?ss:jn,l=t;for(let h=0;h<i.length;h++){let m=i[h];if(m[1]>m[0]){let v=m[0]-l;v>0&&o(a,l,r,v,r+n),l=m[1]}}let c=t+s-l,d=10;c>0&&o(a,l,r-d/2,c,r+n+d)}return a}function cd(i,e,t){let r=i[i.length-1];r&&r[0]==e?r[1]=t:i.push([e,t])}function qn(i,e,t,r,s,n,a){let o=[],l=i.length;for(let c=s==1?t:r;c>=t&&c<=r;c+=s)if(e[c]===null){let h=c,m=c;if(s==1)for(;++c<=r&&e[c]===null;)m=c;else for(;--c>=t&&e[c]===null;)m=c;let v=n(i[h]),y=m==h?v:n(i[m]),w=h-s;v=a<=0&&w>=0&&w<l?n(i[w]):v;let S=m+s;y=a>=0&&S>=0&&S<l?n(i[S]):y,y>=v&&o.push([v,y])}return o}function Bo(i){return i==0?Jo:i==1?Ne:e=>vr(e,i)}function xl(i){let e=i==0?rs:is,t=i==0?(s,n,a,o,l,c)=>{s.arcTo(n,a,o,l,c)}:(s,n,a,o,l,c)=>{s.arcTo(a,n,l,o,c)},r=i==0?(s,n,a,o,l)=>{s.rect(n,a,o,l)}:(s,n,a,o,l)=>{s.rect(a,n,l,o)};return(s,n,a,o,l,c=0,d=0)=>{c==0&&d==0?r(s,n,a,o,l):(c=kt(c,o/2,l/2),d=kt(d,o/2,l/2),e(s,n+c,a),t(s,n+o,a,n+o,a+l,c),t(s,n+o,a+l,n,a+l,d),t(s,n,a+l,n,a,d),t(s,n,a,n+o,a,c),s.closePath())}}var rs=(i,e,t)=>{i.moveTo(e,t)},is=(i,e,t)=>{i.moveTo(t,e)},ei=(i,e,t)=>{i.lineTo(e,t)},ti=(i,e,t)=>{i.lineTo(t,e)},ss=xl(0),jn=xl(1),El=(i,e,t,r,s,n)=>{i.arc(e,t,r,s,n)},Sl=(i,e,t,r,s,n)=>{i.arc(t,e,r,s,n)},Al=(i,e,t,r,s,n,a)=>{i.bezierCurveTo(e,t,r,s,n,a)},Ml=(i,e,t,r,s,n,a)=>{i.bezierCurveTo(t,e,s,r,a,n)};function Tl(i){return(e,t,r,s,n)=>xr(e,t,(a,o,l,c,d,h,m,v,y,w,x)=>{let{pxRound:S,points:E}=a,T,A;c.ori==0?(T=rs,A=El):(T=is,A=Sl);let G=pe(E.width*ce,3),I=(E.size-E.width)/2*ce,D=pe(I*2,3),U=new Path2D,Y=new Path2D,{left:X,top:P,width:K,height:V}=e.bbox;ss(Y,X-D,P-D,K+D*2,V+D*2);let j=z=>{if(l[z]!=null){let J=S(h(o[z],c,w,v)),W=S(m(l[z],d,x,y));T(U,J+I,W),A(U,J,W,I,0,qi*2)}};if(n)n.forEach(j);else for(let z=r;z<=s;z++)j(z);return{stroke:G>0?U:null,fill:U,clip:Y,flags:Jr|kn}})}function Rl(i){return(e,t,r,s,n,a)=>{r!=s&&(n!=r&&a!=r&&i(e,t,r),n!=s&&a!=s&&i(e,t,s),i(e,t,a))}}var fd=Rl(ei),ud=Rl(ti);function Ll(i){let e=ae(i?.alignGaps,0);return(t,r,s,n)=>xr(t,r,(a,o,l,c,d,h,m,v,y,w,x)=>{[s,n]=Qi(l,s,n);let S=a.pxRound,E=V=>S(h(V,c,w,v)),T=V=>S(m(V,d,x,y)),A,G;c.ori==0?(A=ei,G=fd):(A=ti,G=ud);let I=c.dir*(c.ori==0?1:-1),D={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:Jr},U=D.stroke,Y=!1;if(n-s>=w*4){let V=B=>t.posToVal(B,c.key,!0),j=null,z=null,J,W,et,xe=E(o[I==1?s:n]),se=E(o[s]),he=E(o[n]),ee=V(I==1?se+1:he-1);for(let B=I==1?s:n;B>=s&&B<=n;B+=I){let Ce=o[B],Ee=(I==1?Ce<ee:Ce>ee)?xe:E(Ce),fe=l[B];Ee==xe?fe!=null?(W=fe,j==null?(A(U,Ee,T(W)),J=j=z=W):W<j?j=W:W>z&&(z=W)):fe===null&&(Y=!0):(j!=null&&G(U,xe,T(j),T(z),T(J),T(W)),fe!=null?(W=fe,A(U,Ee,T(W)),j=z=J=W):(j=z=null,fe===null&&(Y=!0)),xe=Ee,ee=V(xe+I))}j!=null&&j!=z&&et!=xe&&G(U,xe,T(j),T(z),T(J),T(W))}else for(let V=I==1?s:n;V>=s&&V<=n;V+=I){let j=l[V];j===null?Y=!0:j!=null&&A(U,E(o[V]),T(j))}let[P,K]=Xn(t,r);if(a.fill!=null||P!=0){let V=D.fill=new Path2D(U),j=a.fillTo(t,r,a.min,a.max,P),z=T(j),J=E(o[s]),W=E(o[n]);I==-1&&([W,J]=[J,W]),A(V,W,z),A(V,J,z)}if(!a.spanGaps){let V=[];Y&&V.push(...qn(o,l,s,n,I,E,e)),D.gaps=V=a.gaps(t,r,s,n,V),D.clip=ts(V,c.ori,v,y,w,x)}return K!=0&&(D.band=K==2?[Xt(t,r,s,n,U,-1),Xt(t,r,s,n,U,1)]:Xt(t,r,s,n,U,K)),D})}function hd(i){let e=ae(i.align,1),t=ae(i.ascDesc,!1),r=ae(i.alignGaps,0),s=ae(i.extend,!1);return(n,a,o,l)=>xr(n,a,(c,d,h,m,v,y,w,x,S,E,T)=>{[o,l]=Qi(h,o,l);let A=c.pxRound,{left:G,width:I}=n.bbox,D=se=>A(y(se,m,E,x)),U=se=>A(w(se,v,T,S)),Y=m.ori==0?ei:ti,X={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:Jr},P=X.stroke,K=m.dir*(m.ori==0?1:-1),V=U(h[K==1?o:l]),j=D(d[K==1?o:l]),z=j,J=j;s&&e==-1&&(J=G,Y(P,J,V)),Y(P,j,V);for(let se=K==1?o:l;se>=o&&se<=l;se+=K){let he=h[se];if(he==null)continue;let ee=D(d[se]),B=U(he);e==1?Y(P,ee,V):Y(P,z,B),Y(P,ee,B),V=B,z=ee}let W=z;s&&e==1&&(W=G+I,Y(P,W,V));let[et,xe]=Xn(n,a);if(c.fill!=null||et!=0){let se=X.fill=new Path2D(P),he=c.fillTo(n,a,c.min,c.max,et),ee=U(he);Y(se,W,ee),Y(se,J,ee)}if(!c.spanGaps){let se=[];se.push(...qn(d,h,o,l,K,D,r));let he=c.width*ce/2,ee=t||e==1?he:-he,B=t||e==-1?-he:he;se.forEach(Ce=>{Ce[0]+=ee,Ce[1]+=B}),X.gaps=se=c.gaps(n,a,o,l,se),X.clip=ts(se,m.ori,x,S,E,T)}return xe!=0&&(X.band=xe==2?[Xt(n,a,o,l,P,-1),Xt(n,a,o,l,P,1)]:Xt(n,a,o,l,P,xe)),X})}function Ho(i,e,t,r,s,n,a=me){if(i.length>1){let o=null;for(let l=0,c=1/0;l<i.length;l++)if(e[l]!==void 0){if(o!=null){let d=De(i[l]-i[o]);d<c&&(c=d,a=De(t(i[l],r,s,n)-t(i[o],r,s,n)))}o=l}}return a}function dd(i){i=i||yi;let e=ae(i.size,[.6,me,1]),t=i.align||0,r=i.gap||0,s=i.radius;s=s==null?[0,0]:typeof s=="number"?[s,0]:s;let n=ie(s),a=1-e[0],o=ae(e[1],me),l=ae(e[2],1),c=ae(i.disp,yi),d=ae(i.each,v=>{}),{fill:h,stroke:m}=c;return(v,y,w,x)=>xr(v,y,(S,E,T,A,G,I,D,U,Y,X,P)=>{let K=S.pxRound,V=t,j=r*ce,z=o*ce,J=l*ce,W,et;A.ori==0?[W,et]=n(v,y):[et,W]=n(v,y);let xe=A.dir*(A.ori==0?1:-1),se=A.ori==0?ss:jn,he=A.ori==0?d:(C,ge,Oe,Lr,lr,Ot,cr)=>{d(C,ge,Oe,lr,Lr,cr,Ot)},ee=ae(v.bands,Gn).find(C=>C.series[0]==y),B=ee!=null?ee.dir:0,Ce=S.fillTo(v,y,S.min,S.max,B),je=K(D(Ce,G,P,Y)),Ee,fe,At,nt=X,Te=K(S.width*ce),Ct=!1,Bt=null,mt=null,jt=null,Mr=null;h!=null&&(Te==0||m!=null)&&(Ct=!0,Bt=h.values(v,y,w,x),mt=new Map,new Set(Bt).forEach(C=>{C!=null&&mt.set(C,new Path2D)}),Te>0&&(jt=m.values(v,y,w,x),Mr=new Map,new Set(jt).forEach(C=>{C!=null&&Mr.set(C,new Path2D)})));let{x0:Tr,size:si}=c;if(Tr!=null&&si!=null){V=1,E=Tr.values(v,y,w,x),Tr.unit==2&&(E=E.map(Oe=>v.posToVal(U+Oe*X,A.key,!0)));let C=si.values(v,y,w,x);si.unit==2?fe=C[0]*X:fe=I(C[0],A,X,U)-I(0,A,X,U),nt=Ho(E,T,I,A,X,U,nt),At=nt-fe+j}else nt=Ho(E,T,I,A,X,U,nt),At=nt*a+j,fe=nt-At;At<1&&(At=0),Te>=fe/2&&(Te=0),At<5&&(K=Jo);let Li=At>0,ar=nt-At-(Li?Te:0);fe=K(Ln(ar,J,z)),Ee=(V==0?fe/2:V==xe?0:fe)-V*xe*((V==0?j/2:0)+(Li?Te/2:0));let $e={stroke:null,fill:null,clip:null,band:null,gaps:null,flags:0},Rr=Ct?null:new Path2D,Ht=null;if(ee!=null)Ht=v.data[ee.series[1]];else{let{y0:C,y1:ge}=c;C!=null&&ge!=null&&(T=ge.values(v,y,w,x),Ht=C.values(v,y,w,x))}let or=W*fe,Z=et*fe;for(let C=xe==1?w:x;C>=w&&C<=x;C+=xe){let ge=T[C];if(ge==null)continue;if(Ht!=null){let tt=Ht[C]??0;if(ge-tt==0)continue;je=D(tt,G,P,Y)}let Oe=A.distr!=2||c!=null?E[C]:C,Lr=I(Oe,A,X,U),lr=D(ae(ge,Ce),G,P,Y),Ot=K(Lr-Ee),cr=K(Ze(lr,je)),at=K(kt(lr,je)),pt=cr-at;if(ge!=null){let tt=ge<0?Z:or,Mt=ge<0?or:Z;Ct?(Te>0&&jt[C]!=null&&se(Mr.get(jt[C]),Ot,at+ht(Te/2),fe,Ze(0,pt-Te),tt,Mt),Bt[C]!=null&&se(mt.get(Bt[C]),Ot,at+ht(Te/2),fe,Ze(0,pt-Te),tt,Mt)):se(Rr,Ot,at+ht(Te/2),fe,Ze(0,pt-Te),tt,Mt),he(v,y,C,Ot-Te/2,at,fe+Te,pt)}}return Te>0?$e.stroke=Ct?Mr:Rr:Ct||($e._fill=S.width==0?S._fill:S._stroke??S._fill,$e.width=0),$e.fill=Ct?mt:Rr,$e})}function md(i,e){let t=ae(e?.alignGaps,0);return(r,s,n,a)=>xr(r,s,(o,l,c,d,h,m,v,y,w,x,S)=>{[n,a]=Qi(c,n,a);let E=o.pxRound,T=W=>E(m(W,d,x,y)),A=W=>E(v(W,h,S,w)),G,I,D;d.ori==0?(G=rs,D=ei,I=Al):(G=is,D=ti,I=Ml);let U=d.dir*(d.ori==0?1:-1),Y=T(l[U==1?n:a]),X=Y,P=[],K=[];for(let W=U==1?n:a;W>=n&&W<=a;W+=U)if(c[W]!=null){let xe=l[W],se=T(xe);P.push(X=se),K.push(A(c[W]))}let V={stroke:i(P,K,G,D,I,E),fill:null,clip:null,band:null,gaps:null,flags:Jr},j=V.stroke,[z,J]=Xn(r,s);if(o.fill!=null||z!=0){let W=V.fill=new Path2D(j),et=o.fillTo(r,s,o.min,o.max,z),xe=A(et);D(W,X,xe),D(W,Y,xe)}if(!o.spanGaps){let W=[];W.push(...qn(l,c,n,a,U,T,t)),V.gaps=W=o.gaps(r,s,n,a,W),V.clip=ts(W,d.ori,y,w,x,S)}return J!=0&&(V.band=J==2?[Xt(r,s,n,a,j,-1),Xt(r,s,n,a,j,1)]:Xt(r,s,n,a,j,J)),V})}function pd(i){return md(gd,i)}function gd(i,e,t,r,s,n){let a=i.length;if(a<2)return null;let o=new Path2D;if(t(o,i[0],e[0]),a==2)r(o,i[1],e[1]);else{let l=Array(a),c=Array(a-1),d=Array(a-1),h=Array(a-1);for(let m=0;m<a-1;m++)d[m]=e[m+1]-e[m],h[m]=i[m+1]-i[m],c[m]=d[m]/h[m];l[0]=c[0];for(let m=1;m<a-1;m++)c[m]===0||c[m-1]===0||c[m-1]>0!=c[m]>0?l[m]=0:(l[m]=3*(h[m-1]+h[m])/((2*h[m]+h[m-1])/c[m-1]+(h[m]+2*h[m-1])/c[m]),isFinite(l[m])||(l[m]=0));l[a-1]=c[a-2];for(let m=0;m<a-1;m++)s(o,i[m]+h[m]/3,e[m]+l[m]*h[m]/3,i[m+1]-h[m]/3,e[m+1]-l[m+1]*h[m]/3,i[m+1],e[m+1])}return o}var Fn=new Set;function Wo(){for(let i of Fn)i.syncRect(!0)}Zr&&(br(Ku,jr,Wo),br(Qu,jr,Wo,!0),br(ji,jr,()=>{We.pxRatio=ce}));var vd=Ll(),_d=Tl();function Yo(i,e,t,r){return(r?[i[0],i[1]].concat(i.slice(2)):[i[0]].concat(i.slice(1))).map((n,a)=>Cn(n,a,e,t))}function yd(i,e){return i.map((t,r)=>r==0?{}:Fe({},e,t))}function Cn(i,e,t,r){return Fe({},e==0?t:r,i)}function Pl(i,e,t){return e==null?Kr:[e,t]}var bd=Pl;function wd(i,e,t){return e==null?Kr:$i(e,t,Vn,!0)}function Il(i,e,t,r){return e==null?Kr:Ji(e,t,i.scales[r].log,!1)}var xd=Il;function kl(i,e,t,r){return e==null?Kr:Un(e,t,i.scales[r].log,!1)}var Ed=kl;function Sd(i,e,t,r,s){let n=Ze(Eo(i),Eo(e)),a=e-i,o=It(s/r*a,t);do{let l=t[o],c=r*l/a;if(c>=s&&n+(l<5?rr.get(l):0)<=17)return[l,c]}while(++o<t.length);return[0,0]}function Xo(i){let e,t;return i=i.replace(/(\d+)px/,(r,s)=>(e=Ne((t=+s)*ce))+"px"),[i,e,t]}function Ad(i){i.show&&[i.font,i.labelFont].forEach(e=>{let t=pe(e[2]*ce,1);e[0]=e[0].replace(/[0-9.]+px/,t+"px"),e[1]=t})}function We(i,e,t){let r={mode:ae(i.mode,1)},s=r.mode;function n(f,u,p,g){let _=u.valToPct(f);return g+p*(u.dir==-1?1-_:_)}function a(f,u,p,g){let _=u.valToPct(f);return g+p*(u.dir==-1?_:1-_)}function o(f,u,p,g){return u.ori==0?n(f,u,p,g):a(f,u,p,g)}r.valToPosH=n,r.valToPosV=a;let l=!1;r.status=0;let c=r.root=xt(ku);if(i.id!=null&&(c.id=i.id),ut(c,i.class),i.title){let f=xt(Ou,c);f.textContent=i.title}let d=Pt("canvas"),h=r.ctx=d.getContext("2d"),m=xt(Nu,c);br("click",m,f=>{f.target===y&&(_e!=zr||Se!=Gr)&&Xe.click(r,f)},!0);let v=r.under=xt(Du,m);m.appendChild(d);let y=r.over=xt(Uu,m);i=Qr(i);let w=+ae(i.pxAlign,1),x=Bo(w);(i.plugins||[]).forEach(f=>{f.opts&&(i=f.opts(r,i)||i)});let S=i.ms||.001,E=r.series=s==1?Yo(i.series||[],Oo,zo,!1):yd(i.series||[null],Vo),T=r.axes=Yo(i.axes||[],Co,Do,!0),A=r.scales={},G=r.bands=i.bands||[];G.forEach(f=>{f.fill=ie(f.fill||null),f.dir=ae(f.dir,-1)});let I=s==2?E[1].facets[0].scale:E[0].scale,D={axes:uu,series:au},U=(i.drawOrder||["axes","series"]).map(f=>D[f]);function Y(f){let u=f.distr==3?p=>Yt(p>0?p:f.clamp(r,p,f.min,f.max,f.key)):f.distr==4?p=>wn(p,f.asinh):f.distr==100?p=>f.fwd(p):p=>p;return p=>{let g=u(p),{_min:_,_max:b}=f,M=b-_;return(g-_)/M}}function X(f){let u=A[f];if(u==null){let p=(i.scales||yi)[f]||yi;if(p.from!=null){X(p.from);let g=Fe({},A[p.from],p,{key:f});g.valToPct=Y(g),A[f]=g}else{u=A[f]=Fe({},f==I?bl:od,p),u.key=f;let g=u.time,_=u.range,b=tr(_);if((f!=I||s==2&&!g)&&(b&&(_[0]==null||_[1]==null)&&(_={min:_[0]==null?bo:{mode:1,hard:_[0],soft:_[0]},max:_[1]==null?bo:{mode:1,hard:_[1],soft:_[1]}},b=!1),!b&&es(_))){let M=_;_=(R,L,k)=>L==null?Kr:$i(L,k,M)}u.range=ie(_||(g?bd:f==I?u.distr==3?xd:u.distr==4?Ed:Pl:u.distr==3?Il:u.distr==4?kl:wd)),u.auto=ie(b?!1:u.auto),u.clamp=ie(u.clamp||ad),u._min=u._max=null,u.valToPct=Y(u)}}}X("x"),X("y"),s==1&&E.forEach(f=>{X(f.scale)}),T.forEach(f=>{X(f.scale)});for(let f in i.scales)X(f);let P=A[I],K=P.distr,V,j;P.ori==0?(ut(c,Fu),V=n,j=a):(ut(c,Cu),V=a,j=n);let z={};for(let f in A){let u=A[f];(u.min!=null||u.max!=null)&&(z[f]={min:u.min,max:u.max},u.min=u.max=null)}let J=i.tzDate||(f=>new Date(Ne(f/S))),W=i.fmtDate||Bn,et=S==1?Fh(J):Nh(J),xe=Io(J,Po(S==1?kh:Oh,W)),se=Fo(J,ko(Uh,W)),he=[],ee=r.legend=Fe({},Gh,i.legend),B=r.cursor=Fe({},qh,{drag:{y:s==2}},i.cursor),Ce=ee.show,je=B.show,Ee=ee.markers;ee.idxs=he,Ee.width=ie(Ee.width),Ee.dash=ie(Ee.dash),Ee.stroke=ie(Ee.stroke),Ee.fill=ie(Ee.fill);let fe,At,nt,Te=[],Ct=[],Bt,mt=!1,jt={};if(ee.live){let f=E[1]?E[1].values:null;mt=f!=null,Bt=mt?f(r,1,0):{_:0};for(let u in Bt)jt[u]=Nn}if(Ce)if(fe=Pt("table",Wu,c),nt=Pt("tbody",null,fe),ee.mount(r,fe),mt){At=Pt("thead",null,fe,nt);let f=Pt("tr",null,At);Pt("th",null,f);for(var Mr in Bt)Pt("th",ao,f).textContent=Mr}else ut(fe,Xu),ee.live&&ut(fe,Yu);let Tr={show:!0},si={show:!1};function Li(f,u){if(u==0&&(mt||!ee.live||s==2))return Kr;let p=[],g=Pt("tr",qu,nt,nt.childNodes[u]);ut(g,f.class),f.show||ut(g,yr);let _=Pt("th",null,g);if(Ee.show){let R=xt(ju,_);if(u>0){let L=Ee.width(r,u);L&&(R.style.border=L+"px "+Ee.dash(r,u)+" "+Ee.stroke(r,u)),R.style.background=Ee.fill(r,u)}}let b=xt(ao,_);f.label instanceof HTMLElement?b.appendChild(f.label):b.textContent=f.label,u>0&&(Ee.show||(b.style.color=f.width>0?Ee.stroke(r,u):Ee.fill(r,u)),$e("click",_,R=>{if(B._lock)return;ur(R);let L=E.indexOf(f);if((R.ctrlKey||R.metaKey)!=ee.isolate){let k=E.some((F,O)=>O>0&&O!=L&&F.show);E.forEach((F,O)=>{O>0&&Dt(O,k?O==L?Tr:si:Tr,!0,ke.setSeries)})}else Dt(L,{show:!f.show},!0,ke.setSeries)},!1),Ir&&$e(fo,_,R=>{B._lock||(ur(R),Dt(E.indexOf(f),Hr,!0,ke.setSeries))},!1));for(var M in Bt){let R=Pt("td",$u,g);R.textContent="--",p.push(R)}return[g,p]}let ar=new Map;function $e(f,u,p,g=!0){let _=ar.get(u)||{},b=B.bind[f](r,u,p,g);b&&(br(f,u,_[f]=b),ar.set(u,_))}function Rr(f,u,p){let g=ar.get(u)||{};for(let _ in g)(f==null||_==f)&&(Rn(_,u,g[_]),delete g[_]);f==null&&ar.delete(u)}let Ht=0,or=0,Z=0,C=0,ge=0,Oe=0,Lr=ge,lr=Oe,Ot=Z,cr=C,at=0,pt=0,tt=0,Mt=0;r.bbox={};let Bs=!1,Pi=!1,Pr=!1,fr=!1,Ii=!1,gt=!1;function Hs(f,u,p){(p||f!=r.width||u!=r.height)&&_a(f,u),Nr(!1),Pr=!0,Pi=!0,Dr()}function _a(f,u){r.width=Ht=Z=f,r.height=or=C=u,ge=Oe=0,Zf(),eu();let p=r.bbox;at=p.left=vr(ge*ce,.5),pt=p.top=vr(Oe*ce,.5),tt=p.width=vr(Z*ce,.5),Mt=p.height=vr(C*ce,.5)}let Kf=3;function Qf(){let f=!1,u=0;for(;!f;){u++;let p=cu(u),g=fu(u);f=u==Kf||p&&g,f||(_a(r.width,r.height),Pi=!0)}}function Jf({width:f,height:u}){Hs(f,u)}r.setSize=Jf;function Zf(){let f=!1,u=!1,p=!1,g=!1;T.forEach((_,b)=>{if(_.show&&_._show){let{side:M,_size:R}=_,L=M%2,k=_.label!=null?_.labelSize:0,F=R+k;F>0&&(L?(Z-=F,M==3?(ge+=F,g=!0):p=!0):(C-=F,M==0?(Oe+=F,f=!0):u=!0))}}),hr[0]=f,hr[1]=p,hr[2]=u,hr[3]=g,Z-=$t[1]+$t[3],ge+=$t[3],C-=$t[2]+$t[0],Oe+=$t[0]}function eu(){let f=ge+Z,u=Oe+C,p=ge,g=Oe;function _(b,M){switch(b){case 1:return f+=M,f-M;case 2:return u+=M,u-M;case 3:return p-=M,p+M;case 0:return g-=M,g+M}}T.forEach((b,M)=>{if(b.show&&b._show){let R=b.side;b._pos=_(R,b._size),b.label!=null&&(b._lpos=_(R,b.labelSize))}})}if(B.dataIdx==null){let f=B.hover,u=f.skip=new Set(f.skip??[]);u.add(void 0);let p=f.prox=ie(f.prox),g=f.bias??=0;B.dataIdx=(_,b,M,R)=>{if(b==0)return M;let L=M,k=p(_,b,M,R)??me,F=k>=0&&k<me,O=P.ori==0?Z:C,Q=B.left,oe=e[0],ne=e[b];if(u.has(ne[M])){L=null;let re=null,$=null,H;if(g==0||g==-1)for(H=M;re==null&&H-- >0;)u.has(ne[H])||(re=H);if(g==0||g==1)for(H=M;$==null&&H++<ne.length;)u.has(ne[H])||($=H);if(re!=null||$!=null)if(F){let be=re==null?-1/0:V(oe[re],P,O,0),Re=$==null?1/0:V(oe[$],P,O,0),He=Q-be,de=Re-Q;He<=de?He<=k&&(L=re):de<=k&&(L=$)}else L=$==null?re:re==null?$:M-re<=$-M?re:$}else F&&De(Q-V(oe[M],P,O,0))>k&&(L=null);return L}}let ur=f=>{B.event=f};B.idxs=he,B._lock=!1;let qe=B.points;qe.show=ie(qe.show),qe.size=ie(qe.size),qe.stroke=ie(qe.stroke),qe.width=ie(qe.width),qe.fill=ie(qe.fill);let Nt=r.focus=Fe({},i.focus||{alpha:.3},B.focus),Ir=Nt.prox>=0,kr=Ir&&qe.one,vt=[],Fr=[],Cr=[];function ya(f,u){let p=qe.show(r,u);if(p instanceof HTMLElement)return ut(p,Hu),ut(p,f.class),Gt(p,-10,-10,Z,C),y.insertBefore(p,vt[u]),p}function ba(f,u){if(s==1||u>0){let p=s==1&&A[f.scale].time,g=f.value;f.value=p?Mo(g)?Fo(J,ko(g,W)):g||se:g||id,f.label=f.label||(p?$h:jh)}if(kr||u>0){f.width=f.width==null?1:f.width,f.paths=f.paths||vd||oh,f.fillTo=ie(f.fillTo||ld),f.pxAlign=+ae(f.pxAlign,w),f.pxRound=Bo(f.pxAlign),f.stroke=ie(f.stroke||null),f.fill=ie(f.fill||null),f._stroke=f._fill=f._paths=f._focus=null;let p=sd(Ze(1,f.width),1),g=f.points=Fe({},{size:p,width:Ze(1,p*.2),stroke:f.stroke,space:p*2,paths:_d,_stroke:null,_fill:null},f.points);g.show=ie(g.show),g.filter=ie(g.filter),g.fill=ie(g.fill),g.stroke=ie(g.stroke),g.paths=ie(g.paths),g.pxAlign=f.pxAlign}if(Ce){let p=Li(f,u);Te.splice(u,0,p[0]),Ct.splice(u,0,p[1]),ee.values.push(null)}if(je){he.splice(u,0,null);let p=null;kr?u==0&&(p=ya(f,u)):u>0&&(p=ya(f,u)),vt.splice(u,0,p),Fr.splice(u,0,0),Cr.splice(u,0,0)}Be("addSeries",u)}function tu(f,u){u=u??E.length,f=s==1?Cn(f,u,Oo,zo):Cn(f,u,{},Vo),E.splice(u,0,f),ba(E[u],u)}r.addSeries=tu;function ru(f){if(E.splice(f,1),Ce){ee.values.splice(f,1),Ct.splice(f,1);let u=Te.splice(f,1)[0];Rr(null,u.firstChild),u.remove()}je&&(he.splice(f,1),vt.splice(f,1)[0].remove(),Fr.splice(f,1),Cr.splice(f,1)),Be("delSeries",f)}r.delSeries=ru;let hr=[!1,!1,!1,!1];function iu(f,u){if(f._show=f.show,f.show){let p=f.side%2,g=A[f.scale];g==null&&(f.scale=p?E[1].scale:I,g=A[f.scale]);let _=g.time;f.size=ie(f.size),f.space=ie(f.space),f.rotate=ie(f.rotate),tr(f.incrs)&&f.incrs.forEach(M=>{!rr.has(M)&&rr.set(M,tl(M))}),f.incrs=ie(f.incrs||(g.distr==2?Lh:_?S==1?Ih:Ch:_r)),f.splits=ie(f.splits||(_&&g.distr==1?et:g.distr==3?Pn:g.distr==4?Jh:Qh)),f.stroke=ie(f.stroke),f.grid.stroke=ie(f.grid.stroke),f.ticks.stroke=ie(f.ticks.stroke),f.border.stroke=ie(f.border.stroke);let b=f.values;f.values=tr(b)&&!tr(b[0])?ie(b):_?tr(b)?Io(J,Po(b,W)):Mo(b)?Dh(J,b):b||xe:b||Kh,f.filter=ie(f.filter||(g.distr>=3&&g.log==10?td:g.distr==3&&g.log==2?rd:Zo)),f.font=Xo(f.font),f.labelFont=Xo(f.labelFont),f._size=f.size(r,null,u,0),f._space=f._rotate=f._incrs=f._found=f._splits=f._values=null,f._size>0&&(hr[u]=!0,f._el=xt(Vu,m))}}function ni(f,u,p,g){let[_,b,M,R]=p,L=u%2,k=0;return L==0&&(R||b)&&(k=u==0&&!_||u==2&&!M?Ne(Co.size/3):0),L==1&&(_||M)&&(k=u==1&&!b||u==3&&!R?Ne(Do.size/2):0),k}let wa=r.padding=(i.padding||[ni,ni,ni,ni]).map(f=>ie(ae(f,ni))),$t=r._padding=wa.map((f,u)=>f(r,u,hr,0)),Ye,Ue=null,Ve=null,ki=s==1?E[0].idxs:null,Tt=null,ai=!1;function xa(f,u){if(e=f??[],r.data=r._data=e,s==2){Ye=0;for(let p=1;p<E.length;p++)Ye+=e[p][0].length}else{e.length==0&&(r.data=r._data=e=[[]]),Tt=e[0],Ye=Tt.length;let p=e;if(K==2){p=e.slice();let g=p[0]=Array(Ye);for(let _=0;_<Ye;_++)g[_]=_}r._data=e=p}if(Nr(!0),Be("setData"),K==2&&(Pr=!0),u!==!1){let p=P;p.auto(r,ai)?Ws():Qt(I,p.min,p.max),fr=fr||B.left>=0,gt=!0,Dr()}}r.setData=xa;function Ws(){ai=!0;let f,u;s==1&&(Ye>0?(Ue=ki[0]=0,Ve=ki[1]=Ye-1,f=e[0][Ue],u=e[0][Ve],K==2?(f=Ue,u=Ve):f==u&&(K==3?[f,u]=Ji(f,f,P.log,!1):K==4?[f,u]=Un(f,f,P.log,!1):P.time?u=f+Ne(86400/S):[f,u]=$i(f,u,Vn,!0))):(Ue=ki[0]=f=null,Ve=ki[1]=u=null)),Qt(I,f,u)}let Fi,Or,Ys,Xs,qs,js,$s,Ks,Qs,rt;function Ea(f,u,p,g,_,b){f??=lo,p??=Gn,g??="butt",_??=lo,b??="round",f!=Fi&&(h.strokeStyle=Fi=f),_!=Or&&(h.fillStyle=Or=_),u!=Ys&&(h.lineWidth=Ys=u),b!=qs&&(h.lineJoin=qs=b),g!=js&&(h.lineCap=js=g),p!=Xs&&h.setLineDash(Xs=p)}function Sa(f,u,p,g){u!=Or&&(h.fillStyle=Or=u),f!=$s&&(h.font=$s=f),p!=Ks&&(h.textAlign=Ks=p),g!=Qs&&(h.textBaseline=Qs=g)}function Js(f,u,p,g,_=0){if(g.length>0&&f.auto(r,ai)&&(u==null||u.min==null)){let b=ae(Ue,0),M=ae(Ve,g.length-1),R=p.min==null?th(g,b,M,_,f.distr==3):[p.min,p.max];f.min=kt(f.min,p.min=R[0]),f.max=Ze(f.max,p.max=R[1])}}let Aa={min:null,max:null};function su(){for(let g in A){let _=A[g];z[g]==null&&(_.min==null||z[I]!=null&&_.auto(r,ai))&&(z[g]=Aa)}for(let g in A){let _=A[g];z[g]==null&&_.from!=null&&z[_.from]!=null&&(z[g]=Aa)}z[I]!=null&&Nr(!0);let f={};for(let g in z){let _=z[g];if(_!=null){let b=f[g]=Qr(A[g],fh);if(_.min!=null)Fe(b,_);else if(g!=I||s==2)if(Ye==0&&b.from==null){let M=b.range(r,null,null,g);b.min=M[0],b.max=M[1]}else b.min=me,b.max=-me}}if(Ye>0){E.forEach((g,_)=>{if(s==1){let b=g.scale,M=z[b];if(M==null)return;let R=f[b];if(_==0){let L=R.range(r,R.min,R.max,b);R.min=L[0],R.max=L[1],Ue=It(R.min,e[0]),Ve=It(R.max,e[0]),Ve-Ue>1&&(e[0][Ue]<R.min&&Ue++,e[0][Ve]>R.max&&Ve--),g.min=Tt[Ue],g.max=Tt[Ve]}else g.show&&g.auto&&Js(R,M,g,e[_],g.sorted);g.idxs[0]=Ue,g.idxs[1]=Ve}else if(_>0&&g.show&&g.auto){let[b,M]=g.facets,R=b.scale,L=M.scale,[k,F]=e[_],O=f[R],Q=f[L];O!=null&&Js(O,z[R],b,k,b.sorted),Q!=null&&Js(Q,z[L],M,F,M.sorted),g.min=M.min,g.max=M.max}});for(let g in f){let _=f[g],b=z[g];if(_.from==null&&(b==null||b.min==null)){let M=_.range(r,_.min==me?null:_.min,_.max==-me?null:_.max,g);_.min=M[0],_.max=M[1]}}}for(let g in f){let _=f[g];if(_.from!=null){let b=f[_.from];if(b.min==null)_.min=_.max=null;else{let M=_.range(r,b.min,b.max,g);_.min=M[0],_.max=M[1]}}}let u={},p=!1;for(let g in f){let _=f[g],b=A[g];if(b.min!=_.min||b.max!=_.max){b.min=_.min,b.max=_.max;let M=b.distr;b._min=M==3?Yt(b.min):M==4?wn(b.min,b.asinh):M==100?b.fwd(b.min):b.min,b._max=M==3?Yt(b.max):M==4?wn(b.max,b.asinh):M==100?b.fwd(b.max):b.max,u[g]=p=!0}}if(p){E.forEach((g,_)=>{s==2?_>0&&u.y&&(g._paths=null):u[g.scale]&&(g._paths=null)});for(let g in u)Pr=!0,Be("setScale",g);je&&B.left>=0&&(fr=gt=!0)}for(let g in z)z[g]=null}function nu(f){let u=Ln(Ue-1,0,Ye-1),p=Ln(Ve+1,0,Ye-1);for(;f[u]==null&&u>0;)u--;for(;f[p]==null&&p<Ye-1;)p++;return[u,p]}function au(){if(Ye>0){let f=E.some(u=>u._focus)&&rt!=Nt.alpha;f&&(h.globalAlpha=rt=Nt.alpha),E.forEach((u,p)=>{if(p>0&&u.show&&(Ma(p,!1),Ma(p,!0),u._paths==null)){let g=rt;rt!=u.alpha&&(h.globalAlpha=rt=u.alpha);let _=s==2?[0,e[p][0].length-1]:nu(e[p]);u._paths=u.paths(r,p,_[0],_[1]),rt!=g&&(h.globalAlpha=rt=g)}}),E.forEach((u,p)=>{if(p>0&&u.show){let g=rt;rt!=u.alpha&&(h.globalAlpha=rt=u.alpha),u._paths!=null&&Ta(p,!1);{let _=u._paths!=null?u._paths.gaps:null,b=u.points.show(r,p,Ue,Ve,_),M=u.points.filter(r,p,b,_);(b||M)&&(u.points._paths=u.points.paths(r,p,Ue,Ve,M),Ta(p,!0))}rt!=g&&(h.globalAlpha=rt=g),Be("drawSeries",p)}}),f&&(h.globalAlpha=rt=1)}}function Ma(f,u){let p=u?E[f].points:E[f];p._stroke=p.stroke(r,f),p._fill=p.fill(r,f)}function Ta(f,u){let p=u?E[f].points:E[f],{stroke:g,fill:_,clip:b,flags:M,_stroke:R=p._stroke,_fill:L=p._fill,_width:k=p.width}=p._paths;k=pe(k*ce,3);let F=null,O=k%2/2;u&&L==null&&(L=k>0?"#fff":R);let Q=p.pxAlign==1&&O>0;if(Q&&h.translate(O,O),!u){let oe=at-k/2,ne=pt-k/2,re=tt+k,$=Mt+k;F=new Path2D,F.rect(oe,ne,re,$)}u?Zs(R,k,p.dash,p.cap,L,g,_,M,b):ou(f,R,k,p.dash,p.cap,L,g,_,M,F,b),Q&&h.translate(-O,-O)}function ou(f,u,p,g,_,b,M,R,L,k,F){let O=!1;L!=0&&G.forEach((Q,oe)=>{if(Q.series[0]==f){let ne=E[Q.series[1]],re=e[Q.series[1]],$=(ne._paths||yi).band;tr($)&&($=Q.dir==1?$[0]:$[1]);let H,be=null;ne.show&&$&&ih(re,Ue,Ve)?(be=Q.fill(r,oe)||b,H=ne._paths.clip):$=null,Zs(u,p,g,_,be,M,R,L,k,F,H,$),O=!0}}),O||Zs(u,p,g,_,b,M,R,L,k,F)}let Ra=Jr|kn;function Zs(f,u,p,g,_,b,M,R,L,k,F,O){Ea(f,u,p,g,_),(L||k||O)&&(h.save(),L&&h.clip(L),k&&h.clip(k)),O?(R&Ra)==Ra?(h.clip(O),F&&h.clip(F),Oi(_,M),Ci(f,b,u)):R&kn?(Oi(_,M),h.clip(O),Ci(f,b,u)):R&Jr&&(h.save(),h.clip(O),F&&h.clip(F),Oi(_,M),h.restore(),Ci(f,b,u)):(Oi(_,M),Ci(f,b,u)),(L||k||O)&&h.restore()}function Ci(f,u,p){p>0&&(u instanceof Map?u.forEach((g,_)=>{h.strokeStyle=Fi=_,h.stroke(g)}):u!=null&&f&&h.stroke(u))}function Oi(f,u){u instanceof Map?u.forEach((p,g)=>{h.fillStyle=Or=g,h.fill(p)}):u!=null&&f&&h.fill(u)}function lu(f,u,p,g){let _=T[f],b;if(g<=0)b=[0,0];else{let M=_._space=_.space(r,f,u,p,g),R=_._incrs=_.incrs(r,f,u,p,g,M);b=Sd(u,p,R,g,M)}return _._found=b}function en(f,u,p,g,_,b,M,R,L,k){let F=M%2/2;w==1&&h.translate(F,F),Ea(R,M,L,k,R),h.beginPath();let O,Q,oe,ne,re=_+(g==0||g==3?-b:b);p==0?(Q=_,ne=re):(O=_,oe=re);for(let $=0;$<f.length;$++)u[$]!=null&&(p==0?O=oe=f[$]:Q=ne=f[$],h.moveTo(O,Q),h.lineTo(oe,ne));h.stroke(),w==1&&h.translate(-F,-F)}function cu(f){let u=!0;return T.forEach((p,g)=>{if(!p.show)return;let _=A[p.scale];if(_.min==null){p._show&&(u=!1,p._show=!1,Nr(!1));return}else p._show||(u=!1,p._show=!0,Nr(!1));let b=p.side,M=b%2,{min:R,max:L}=_,[k,F]=lu(g,R,L,M==0?Z:C);if(F==0)return;let O=_.distr==2,Q=p._splits=p.splits(r,g,R,L,k,F,O),oe=_.distr==2?Q.map(H=>Tt[H]):Q,ne=_.distr==2?Tt[Q[1]]-Tt[Q[0]]:k,re=p._values=p.values(r,p.filter(r,oe,g,F,ne),g,F,ne);p._rotate=b==2?p.rotate(r,re,g,F):0;let $=p._size;p._size=Et(p.size(r,re,g,f)),$!=null&&p._size!=$&&(u=!1)}),u}function fu(f){let u=!0;return wa.forEach((p,g)=>{let _=p(r,g,hr,f);_!=$t[g]&&(u=!1),$t[g]=_}),u}function uu(){for(let f=0;f<T.length;f++){let u=T[f];if(!u.show||!u._show)continue;let p=u.side,g=p%2,_,b,M=u.stroke(r,f),R=p==0||p==3?-1:1,[L,k]=u._found;if(u.label!=null){let Qe=u.labelGap*R,ct=Ne((u._lpos+Qe)*ce);Sa(u.labelFont[0],M,"center",p==2?"top":oo),h.save(),g==1?(_=b=0,h.translate(ct,Ne(pt+Mt/2)),h.rotate((p==3?-qi:qi)/2)):(_=Ne(at+tt/2),b=ct);let pr=Qo(u.label)?u.label(r,f,L,k):u.label;h.fillText(pr,_,b),h.restore()}if(k==0)continue;let F=A[u.scale],O=g==0?tt:Mt,Q=g==0?at:pt,oe=u._splits,ne=F.distr==2?oe.map(Qe=>Tt[Qe]):oe,re=F.distr==2?Tt[oe[1]]-Tt[oe[0]]:L,$=u.ticks,H=u.border,be=$.show?$.size:0,Re=Ne(be*ce),He=Ne((u.alignTo==2?u._size-be-u.gap:u.gap)*ce),de=u._rotate*-qi/180,Le=x(u._pos*ce),ot=(Re+He)*R,Ke=Le+ot;b=g==0?Ke:0,_=g==1?Ke:0;let _t=u.font[0],Rt=u.align==1?Xr:u.align==2?_n:de>0?Xr:de<0?_n:g==0?"center":p==3?_n:Xr,Vt=de||g==1?"middle":p==2?"top":oo;Sa(_t,M,Rt,Vt);let lt=u.font[1]*u.lineGap,yt=oe.map(Qe=>x(o(Qe,F,O,Q))),Lt=u._values;for(let Qe=0;Qe<Lt.length;Qe++){let ct=Lt[Qe];if(ct!=null){g==0?_=yt[Qe]:b=yt[Qe],ct=""+ct;let pr=ct.indexOf(`
`)==-1?[ct]:ct.split(/\n/gm);for(let Je=0;Je<pr.length;Je++){let qa=pr[Je];de?(h.save(),h.translate(_,b+Je*lt),h.rotate(de),h.fillText(qa,0,0),h.restore()):h.fillText(qa,_,b+Je*lt)}}}$.show&&en(yt,$.filter(r,ne,f,k,re),g,p,Le,Re,pe($.width*ce,3),$.stroke(r,f),$.dash,$.cap);let zt=u.grid;zt.show&&en(yt,zt.filter(r,ne,f,k,re),g,g==0?2:1,g==0?pt:at,g==0?Mt:tt,pe(zt.width*ce,3),zt.stroke(r,f),zt.dash,zt.cap),H.show&&en([Le],[1],g==0?1:0,g==0?1:2,g==1?pt:at,g==1?Mt:tt,pe(H.width*ce,3),H.stroke(r,f),H.dash,H.cap)}Be("drawAxes")}function Nr(f){E.forEach((u,p)=>{p>0&&(u._paths=null,f&&(s==1?(u.min=null,u.max=null):u.facets.forEach(g=>{g.min=null,g.max=null})))})}let Ni=!1,tn=!1,oi=[];function hu(){tn=!1;for(let f=0;f<oi.length;f++)Be(...oi[f]);oi.length=0}function Dr(){Ni||(vh(La),Ni=!0)}function du(f,u=!1){Ni=!0,tn=u,f(r),La(),u&&oi.length>0&&queueMicrotask(hu)}r.batch=du;function La(){if(Bs&&(su(),Bs=!1),Pr&&(Qf(),Pr=!1),Pi){if(we(v,Xr,ge),we(v,"top",Oe),we(v,pi,Z),we(v,gi,C),we(y,Xr,ge),we(y,"top",Oe),we(y,pi,Z),we(y,gi,C),we(m,pi,Ht),we(m,gi,or),d.width=Ne(Ht*ce),d.height=Ne(or*ce),T.forEach(({_el:f,_show:u,_size:p,_pos:g,side:_})=>{if(f!=null)if(u){let b=_===3||_===0?p:0,M=_%2==1;we(f,M?"left":"top",g-b),we(f,M?"width":"height",p),we(f,M?"top":"left",M?Oe:ge),we(f,M?"height":"width",M?C:Z),Tn(f,yr)}else ut(f,yr)}),Fi=Or=Ys=qs=js=$s=Ks=Qs=Xs=null,rt=1,fi(!0),ge!=Lr||Oe!=lr||Z!=Ot||C!=cr){Nr(!1);let f=Z/Ot,u=C/cr;if(je&&!fr&&B.left>=0){B.left*=f,B.top*=u,Ur&&Gt(Ur,Ne(B.left),0,Z,C),Vr&&Gt(Vr,0,Ne(B.top),Z,C);for(let p=0;p<vt.length;p++){let g=vt[p];g!=null&&(Fr[p]*=f,Cr[p]*=u,Gt(g,Et(Fr[p]),Et(Cr[p]),Z,C))}}if(ye.show&&!Ii&&ye.left>=0&&ye.width>0){ye.left*=f,ye.width*=f,ye.top*=u,ye.height*=u;for(let p in ln)we(Br,p,ye[p])}Lr=ge,lr=Oe,Ot=Z,cr=C}Be("setSize"),Pi=!1}Ht>0&&or>0&&(h.clearRect(0,0,d.width,d.height),Be("drawClear"),U.forEach(f=>f()),Be("draw")),ye.show&&Ii&&(Di(ye),Ii=!1),je&&fr&&(mr(null,!0,!1),fr=!1),ee.show&&ee.live&&gt&&(an(),gt=!1),l||(l=!0,r.status=1,Be("ready")),ai=!1,Ni=!1}r.redraw=(f,u)=>{Pr=u||!1,f!==!1?Qt(I,P.min,P.max):Dr()};function rn(f,u){let p=A[f];if(p.from==null){if(Ye==0){let g=p.range(r,u.min,u.max,f);u.min=g[0],u.max=g[1]}if(u.min>u.max){let g=u.min;u.min=u.max,u.max=g}if(Ye>1&&u.min!=null&&u.max!=null&&u.max-u.min<1e-16)return;f==I&&p.distr==2&&Ye>0&&(u.min=It(u.min,e[0]),u.max=It(u.max,e[0]),u.min==u.max&&u.max++),z[f]=u,Bs=!0,Dr()}}r.setScale=rn;let sn,nn,Ur,Vr,Pa,Ia,zr,Gr,ka,Fa,_e,Se,Kt=!1,Xe=B.drag,ze=Xe.x,Ge=Xe.y;je&&(B.x&&(sn=xt(Gu,y)),B.y&&(nn=xt(Bu,y)),P.ori==0?(Ur=sn,Vr=nn):(Ur=nn,Vr=sn),_e=B.left,Se=B.top);let ye=r.select=Fe({show:!0,over:!0,left:0,width:0,top:0,height:0},i.select),Br=ye.show?xt(zu,ye.over?y:v):null;function Di(f,u){if(ye.show){for(let p in f)ye[p]=f[p],p in ln&&we(Br,p,f[p]);u!==!1&&Be("setSelect")}}r.setSelect=Di;function mu(f){if(E[f].show)Ce&&Tn(Te[f],yr);else if(Ce&&ut(Te[f],yr),je){let p=kr?vt[0]:vt[f];p!=null&&Gt(p,-10,-10,Z,C)}}function Qt(f,u,p){rn(f,{min:u,max:p})}function Dt(f,u,p,g){u.focus!=null&&yu(f),u.show!=null&&E.forEach((_,b)=>{b>0&&(f==b||f==null)&&(_.show=u.show,mu(b),s==2?(Qt(_.facets[0].scale,null,null),Qt(_.facets[1].scale,null,null)):Qt(_.scale,null,null),Dr())}),p!==!1&&Be("setSeries",f,u),g&&ui("setSeries",r,f,u)}r.setSeries=Dt;function pu(f,u){Fe(G[f],u)}function gu(f,u){f.fill=ie(f.fill||null),f.dir=ae(f.dir,-1),u=u??G.length,G.splice(u,0,f)}function vu(f){f==null?G.length=0:G.splice(f,1)}r.addBand=gu,r.setBand=pu,r.delBand=vu;function _u(f,u){E[f].alpha=u,je&&vt[f]!=null&&(vt[f].style.opacity=u),Ce&&Te[f]&&(Te[f].style.opacity=u)}let Wt,Jt,dr,Hr={focus:!0};function yu(f){if(f!=dr){let u=f==null,p=Nt.alpha!=1;E.forEach((g,_)=>{if(s==1||_>0){let b=u||_==0||_==f;g._focus=u?null:b,p&&_u(_,b?1:Nt.alpha)}}),dr=f,p&&Dr()}}Ce&&Ir&&$e(uo,fe,f=>{B._lock||(ur(f),dr!=null&&Dt(null,Hr,!0,ke.setSeries))});function Ut(f,u,p){let g=A[u];p&&(f=f/ce-(g.ori==1?Oe:ge));let _=Z;g.ori==1&&(_=C,f=_-f),g.dir==-1&&(f=_-f);let b=g._min,M=g._max,R=f/_,L=b+(M-b)*R,k=g.distr;return k==3?$r(10,L):k==4?nh(L,g.asinh):k==100?g.bwd(L):L}function bu(f,u){let p=Ut(f,I,u);return It(p,e[0],Ue,Ve)}r.valToIdx=f=>It(f,e[0]),r.posToIdx=bu,r.posToVal=Ut,r.valToPos=(f,u,p)=>A[u].ori==0?n(f,A[u],p?tt:Z,p?at:0):a(f,A[u],p?Mt:C,p?pt:0),r.setCursor=(f,u,p)=>{_e=f.left,Se=f.top,mr(null,u,p)};function Ca(f,u){we(Br,Xr,ye.left=f),we(Br,pi,ye.width=u)}function Oa(f,u){we(Br,"top",ye.top=f),we(Br,gi,ye.height=u)}let li=P.ori==0?Ca:Oa,ci=P.ori==1?Ca:Oa;function wu(){if(Ce&&ee.live)for(let f=s==2?1:0;f<E.length;f++){if(f==0&&mt)continue;let u=ee.values[f],p=0;for(let g in u)Ct[f][p++].firstChild.nodeValue=u[g]}}function an(f,u){if(f!=null&&(f.idxs?f.idxs.forEach((p,g)=>{he[g]=p}):ch(f.idx)||he.fill(f.idx),ee.idx=he[0]),Ce&&ee.live){for(let p=0;p<E.length;p++)(p>0||s==1&&!mt)&&xu(p,he[p]);wu()}gt=!1,u!==!1&&Be("setLegend")}r.setLegend=an;function xu(f,u){let p=E[f],g=f==0&&K==2?Tt:e[f],_;mt?_=p.values(r,f,u)??jt:(_=p.value(r,u==null?null:g[u],f,u),_=_==null?jt:{_}),ee.values[f]=_}function mr(f,u,p){ka=_e,Fa=Se,[_e,Se]=B.move(r,_e,Se),B.left=_e,B.top=Se,je&&(Ur&&Gt(Ur,Ne(_e),0,Z,C),Vr&&Gt(Vr,0,Ne(Se),Z,C));let g,_=Ue>Ve;Wt=me,Jt=null;let b=P.ori==0?Z:C,M=P.ori==1?Z:C;if(_e<0||Ye==0||_){g=B.idx=null;for(let R=0;R<E.length;R++){let L=vt[R];L!=null&&Gt(L,-10,-10,Z,C)}Ir&&Dt(null,Hr,!0,f==null&&ke.setSeries),ee.live&&(he.fill(g),gt=!0)}else{let R,L,k;s==1&&(R=P.ori==0?_e:Se,L=Ut(R,I),g=B.idx=It(L,e[0],Ue,Ve),k=V(e[0][g],P,b,0));let F=-10,O=-10,Q=0,oe=0,ne=!0,re="",$="";for(let H=s==2?1:0;H<E.length;H++){let be=E[H],Re=he[H],He=Re==null?null:s==1?e[H][Re]:e[H][1][Re],de=B.dataIdx(r,H,g,L),Le=de==null?null:s==1?e[H][de]:e[H][1][de];if(gt=gt||Le!=He||de!=Re,he[H]=de,H>0&&be.show){let ot=de==null?-10:de==g?k:V(s==1?e[0][de]:e[H][0][de],P,b,0),Ke=Le==null?-10:j(Le,s==1?A[be.scale]:A[be.facets[1].scale],M,0);if(Ir&&Le!=null){let _t=P.ori==1?_e:Se,Rt=De(Nt.dist(r,H,de,Ke,_t));if(Rt<Wt){let Vt=Nt.bias;if(Vt!=0){let lt=Ut(_t,be.scale),yt=Le>=0?1:-1,Lt=lt>=0?1:-1;Lt==yt&&(Lt==1?Vt==1?Le>=lt:Le<=lt:Vt==1?Le<=lt:Le>=lt)&&(Wt=Rt,Jt=H)}else Wt=Rt,Jt=H}}if(gt||kr){let _t,Rt;P.ori==0?(_t=ot,Rt=Ke):(_t=Ke,Rt=ot);let Vt,lt,yt,Lt,zt,Qe,ct=!0,pr=qe.bbox;if(pr!=null){ct=!1;let Je=pr(r,H);yt=Je.left,Lt=Je.top,Vt=Je.width,lt=Je.height}else yt=_t,Lt=Rt,Vt=lt=qe.size(r,H);if(Qe=qe.fill(r,H),zt=qe.stroke(r,H),kr)H==Jt&&Wt<=Nt.prox&&(F=yt,O=Lt,Q=Vt,oe=lt,ne=ct,re=Qe,$=zt);else{let Je=vt[H];Je!=null&&(Fr[H]=yt,Cr[H]=Lt,yo(Je,Vt,lt,ct),vo(Je,Qe,zt),Gt(Je,Et(yt),Et(Lt),Z,C))}}}}if(kr){let H=Nt.prox,be=dr==null?Wt<=H:Wt>H||Jt!=dr;if(gt||be){let Re=vt[0];Re!=null&&(Fr[0]=F,Cr[0]=O,yo(Re,Q,oe,ne),vo(Re,re,$),Gt(Re,Et(F),Et(O),Z,C))}}}if(ye.show&&Kt)if(f!=null){let[R,L]=ke.scales,[k,F]=ke.match,[O,Q]=f.cursor.sync.scales,oe=f.cursor.drag;if(ze=oe._x,Ge=oe._y,ze||Ge){let{left:ne,top:re,width:$,height:H}=f.select,be=f.scales[O].ori,Re=f.posToVal,He,de,Le,ot,Ke,_t=R!=null&&k(R,O),Rt=L!=null&&F(L,Q);_t&&ze?(be==0?(He=ne,de=$):(He=re,de=H),Le=A[R],ot=V(Re(He,O),Le,b,0),Ke=V(Re(He+de,O),Le,b,0),li(kt(ot,Ke),De(Ke-ot))):li(0,b),Rt&&Ge?(be==1?(He=ne,de=$):(He=re,de=H),Le=A[L],ot=j(Re(He,Q),Le,M,0),Ke=j(Re(He+de,Q),Le,M,0),ci(kt(ot,Ke),De(Ke-ot))):ci(0,M)}else cn()}else{let R=De(ka-Pa),L=De(Fa-Ia);if(P.ori==1){let Q=R;R=L,L=Q}ze=Xe.x&&R>=Xe.dist,Ge=Xe.y&&L>=Xe.dist;let k=Xe.uni;k!=null?ze&&Ge&&(ze=R>=k,Ge=L>=k,!ze&&!Ge&&(L>R?Ge=!0:ze=!0)):Xe.x&&Xe.y&&(ze||Ge)&&(ze=Ge=!0);let F,O;ze&&(P.ori==0?(F=zr,O=_e):(F=Gr,O=Se),li(kt(F,O),De(O-F)),Ge||ci(0,M)),Ge&&(P.ori==1?(F=zr,O=_e):(F=Gr,O=Se),ci(kt(F,O),De(O-F)),ze||li(0,b)),!ze&&!Ge&&(li(0,0),ci(0,0))}if(Xe._x=ze,Xe._y=Ge,f==null){if(p){if(Xa!=null){let[R,L]=ke.scales;ke.values[0]=R!=null?Ut(P.ori==0?_e:Se,R):null,ke.values[1]=L!=null?Ut(P.ori==1?_e:Se,L):null}ui(yn,r,_e,Se,Z,C,g)}if(Ir){let R=p&&ke.setSeries,L=Nt.prox;dr==null?Wt<=L&&Dt(Jt,Hr,!0,R):Wt>L?Dt(null,Hr,!0,R):Jt!=dr&&Dt(Jt,Hr,!0,R)}}gt&&(ee.idx=g,an()),u!==!1&&Be("setCursor")}let Zt=null;Object.defineProperty(r,"rect",{get(){return Zt==null&&fi(!1),Zt}});function fi(f=!1){f?Zt=null:(Zt=y.getBoundingClientRect(),Be("syncRect",Zt))}function Na(f,u,p,g,_,b,M){B._lock||Kt&&f!=null&&f.movementX==0&&f.movementY==0||(on(f,u,p,g,_,b,M,!1,f!=null),f!=null?mr(null,!0,!0):mr(u,!0,!1))}function on(f,u,p,g,_,b,M,R,L){if(Zt==null&&fi(!1),ur(f),f!=null)p=f.clientX-Zt.left,g=f.clientY-Zt.top;else{if(p<0||g<0){_e=-10,Se=-10;return}let[k,F]=ke.scales,O=u.cursor.sync,[Q,oe]=O.values,[ne,re]=O.scales,[$,H]=ke.match,be=u.axes[0].side%2==1,Re=P.ori==0?Z:C,He=P.ori==1?Z:C,de=be?b:_,Le=be?_:b,ot=be?g:p,Ke=be?p:g;if(ne!=null?p=$(k,ne)?o(Q,A[k],Re,0):-10:p=Re*(ot/de),re!=null?g=H(F,re)?o(oe,A[F],He,0):-10:g=He*(Ke/Le),P.ori==1){let _t=p;p=g,g=_t}}L&&(u==null||u.cursor.event.type==yn)&&((p<=1||p>=Z-1)&&(p=vr(p,Z)),(g<=1||g>=C-1)&&(g=vr(g,C))),R?(Pa=p,Ia=g,[zr,Gr]=B.move(r,p,g)):(_e=p,Se=g)}let ln={width:0,height:0,left:0,top:0};function cn(){Di(ln,!1)}let Da,Ua,Va,za;function Ga(f,u,p,g,_,b,M){Kt=!0,ze=Ge=Xe._x=Xe._y=!1,on(f,u,p,g,_,b,M,!0,!1),f!=null&&($e(bn,An,Ba,!1),ui(co,r,zr,Gr,Z,C,null));let{left:R,top:L,width:k,height:F}=ye;Da=R,Ua=L,Va=k,za=F}function Ba(f,u,p,g,_,b,M){Kt=Xe._x=Xe._y=!1,on(f,u,p,g,_,b,M,!1,!0);let{left:R,top:L,width:k,height:F}=ye,O=k>0||F>0,Q=Da!=R||Ua!=L||Va!=k||za!=F;if(O&&Q&&Di(ye),Xe.setScale&&O&&Q){let oe=R,ne=k,re=L,$=F;if(P.ori==1&&(oe=L,ne=F,re=R,$=k),ze&&Qt(I,Ut(oe,I),Ut(oe+ne,I)),Ge)for(let H in A){let be=A[H];H!=I&&be.from==null&&be.min!=me&&Qt(H,Ut(re+$,H),Ut(re,H))}cn()}else B.lock&&(B._lock=!B._lock,mr(u,!0,f!=null));f!=null&&(Rr(bn,An),ui(bn,r,_e,Se,Z,C,null))}function Eu(f,u,p,g,_,b,M){if(B._lock)return;ur(f);let R=Kt;if(Kt){let L=!0,k=!0,F=10,O,Q;P.ori==0?(O=ze,Q=Ge):(O=Ge,Q=ze),O&&Q&&(L=_e<=F||_e>=Z-F,k=Se<=F||Se>=C-F),O&&L&&(_e=_e<zr?0:Z),Q&&k&&(Se=Se<Gr?0:C),mr(null,!0,!0),Kt=!1}_e=-10,Se=-10,he.fill(null),mr(null,!0,!0),R&&(Kt=R)}function Ha(f,u,p,g,_,b,M){B._lock||(ur(f),Ws(),cn(),f!=null&&ui(ho,r,_e,Se,Z,C,null))}function Wa(){T.forEach(Ad),Hs(r.width,r.height,!0)}br(ji,jr,Wa);let Wr={};Wr.mousedown=Ga,Wr.mousemove=Na,Wr.mouseup=Ba,Wr.dblclick=Ha,Wr.setSeries=(f,u,p,g)=>{let _=ke.match[2];p=_(r,u,p),p!=-1&&Dt(p,g,!0,!1)},je&&($e(co,y,Ga),$e(yn,y,Na),$e(fo,y,f=>{ur(f),fi(!1)}),$e(uo,y,Eu),$e(ho,y,Ha),Fn.add(r),r.syncRect=fi);let Ui=r.hooks=i.hooks||{};function Be(f,u,p){tn?oi.push([f,u,p]):f in Ui&&Ui[f].forEach(g=>{g.call(null,r,u,p)})}(i.plugins||[]).forEach(f=>{for(let u in f.hooks)Ui[u]=(Ui[u]||[]).concat(f.hooks[u])});let Ya=(f,u,p)=>p,ke=Fe({key:null,setSeries:!1,filters:{pub:So,sub:So},scales:[I,E[1]?E[1].scale:null],match:[Ao,Ao,Ya],values:[null,null]},B.sync);ke.match.length==2&&ke.match.push(Ya),B.sync=ke;let Xa=ke.key,fn=wl(Xa);function ui(f,u,p,g,_,b,M){ke.filters.pub(f,u,p,g,_,b,M)&&fn.pub(f,u,p,g,_,b,M)}fn.sub(r);function Su(f,u,p,g,_,b,M){ke.filters.sub(f,u,p,g,_,b,M)&&Wr[f](null,u,p,g,_,b,M)}r.pub=Su;function Au(){fn.unsub(r),Fn.delete(r),ar.clear(),Rn(ji,jr,Wa),c.remove(),fe?.remove(),Be("destroy")}r.destroy=Au;function un(){Be("init",i,e),xa(e||i.data,!1),z[I]?rn(I,z[I]):Ws(),Ii=ye.show&&(ye.width>0||ye.height>0),fr=gt=!0,Hs(i.width,i.height)}return E.forEach(ba),T.forEach(iu),t?t instanceof HTMLElement?(t.appendChild(c),un()):t(r,un):un(),r}We.assign=Fe;We.fmtNum=zn;We.rangeNum=$i;We.rangeLog=Ji;We.rangeAsinh=Un;We.orient=xr;We.pxRatio=ce;We.join=gh;We.fmtDate=Bn,We.tzDate=Th;We.sync=wl;{We.addGap=cd,We.clipGaps=ts;let i=We.paths={points:Tl};i.linear=Ll,i.stepped=hd,i.bars=dd,i.spline=pd}var Fl=96,Md=8,ns=["#2f8fef","#e8820c","#1fa367","#a45ee5","#e5484d","#12a5b8","#b58900","#d6409f","#6e7fd9","#7a8b3a"];function $n(i,e){let[t,r]=[0,i.times.length];for(;t<r;){let s=t+r>>1;i.times[s]<=e+1e-4?t=s+1:r=s}return t===0?null:i.values[t-1]}var ir=class{constructor(e,t){this.container=e;this.seek=t;this.set([]),new ResizeObserver(()=>this.resize()).observe(e)}container;seek;charts=[];time=0;set(e){for(let{plot:t}of this.charts)t.destroy();this.container.replaceChildren(),this.charts=e.map((t,r)=>this.chart(t,r))}redraw(){for(let{plot:e}of this.charts)e.redraw(!1)}show(e,t){this.time=e,t.length===this.charts.length&&t.every((s,n)=>s===this.charts[n].curve)||this.set(t);for(let s of this.charts){let n=$n(s.curve,e);s.value.textContent=Pd(s.curve,n);let a=s.curve.times.at(-1);s.drawnTime!==a&&(s.drawnTime=a,s.plot.setData([s.curve.times,s.curve.values])),this.moveCursor(s)}}moveCursor({plot:e,cursor:t}){let r=e.valToPos(this.time,"x");t.hidden=!(r>=0&&r<=e.over.clientWidth),t.style.transform=`translateX(${r}px)`}chart(e,t){let r=document.createElement("figure"),s=document.createElement("figcaption"),n=document.createElement("button"),a=document.createElement("output");n.textContent=e.name.replaceAll("_"," "),n.title=`${e.name}: fold or unfold`;let o=d=>{r.classList.toggle("folded",d),n.setAttribute("aria-expanded",String(!d))};n.addEventListener("click",()=>o(!r.classList.contains("folded"))),o(t>=Md),n.style.setProperty("--mark",ns[t%ns.length]),s.append(n,a),r.append(s),this.container.append(r);let l=new We(this.options(e,ns[t%ns.length]),[e.times,e.values],r);l.over.addEventListener("click",d=>this.seek(l.posToVal(d.offsetX,"x")));let c=document.createElement("i");return c.className="cursor",l.over.append(c),{curve:e,plot:l,cursor:c,value:a,drawnTime:e.times.at(-1)}}options({names:e,isFraction:t},r){let s=a=>getComputedStyle(this.container).getPropertyValue(a).trim(),n=()=>({stroke:()=>s("--soft"),grid:{stroke:()=>s("--line"),width:1},ticks:{show:!1},font:"10px system-ui, sans-serif"});return{width:Math.max(120,this.container.clientWidth-20),height:Fl,legend:{show:!1},cursor:{y:!1,drag:{x:!1,y:!1},points:{show:!1}},scales:{x:{time:!1},y:{range:Td(e,t)}},axes:[{...n(),size:20,gap:2},{...n(),size:44,gap:2,space:12,values:(a,o,l,c,d)=>o.map(h=>Rd(h,d)),...e?.length?{incrs:[1,2,5,10]}:{}}],series:[{},{stroke:r,width:1.5,spanGaps:!1,paths:e?.length?We.paths.stepped({align:1}):void 0,points:{show:!0,size:4,fill:r,filter:Ld}}]}}resize(){let e=Math.max(120,this.container.clientWidth-20);for(let t of this.charts)t.plot.setSize({width:e,height:Fl}),this.moveCursor(t)}};function Td(i,e){return i?.length?[0,i.length]:e?[0,1]:(t,r,s)=>{if(r===null||s===null)return[0,1];let n=s-r<1e-5*Math.max(Math.abs(r),Math.abs(s),1e-6);if(n&&r>=0)return[0,s>0?2*s:1];let a=n?Math.max(.5,.1*Math.abs(s)):.08*(s-r);return[r-a,s+a]}}function Rd(i,e){let t=[0,1,2,3,4,5].find(r=>Math.abs(e*10**r-Math.round(e*10**r))<1e-6)??9;return Math.abs(i)>=1e5||t>5?i===0?"0":i.toExponential(1):String(Number(i.toFixed(t)))}function Ld(i,e){let t=i.data[e],r=s=>t[s]===null||t[s]===void 0;return[...t.keys()].filter(s=>!r(s)&&r(s-1)&&r(s+1))}function Pd({unit:i,names:e},t){return t===null?"–":e?.length?e[t-1]??"none yet":`${Id(t)} ${i==="1"?"":i}`.trim()}function Id(i){let e=Math.abs(i);return i===0?"0":e>=1e5||e<.001?i.toExponential(2):i.toPrecision(4)}var Kn=3e3,kd=16,as=class{constructor(e){this.request=e;let t=N("topic");t.addEventListener("change",()=>{this.add(t.value),t.value=""})}request;cards=new Map;types={};list(e){this.types=Object.fromEntries(e);let t=N("topic"),r=e.map(([s,n])=>new Option(`${s}  (${n.replace("/msg/","/")})`,s));t.replaceChildren(new Option("Show a topic…",""),...r),N("topics-box").hidden=!e.length}showMessage(e){this.cards.get(e.name)?.showMessage(e)}show(e){for(let t of this.cards.values())t.show(e)}redrawCurves(){for(let e of this.cards.values())e.curves.redraw()}add(e){if(!e||this.cards.has(e)||this.cards.size>=kd)return;let t=new Qn(e,this.types[e]??"",()=>{this.cards.delete(e),this.request([...this.cards.keys()])});this.cards.set(e,t),N("topics").append(t.box),this.request([...this.cards.keys()])}},Qn=class{box=q("div","","topic");curves;rows=new Map;samples=new Map;selection=new Set;table=q("div","","fields");note=q("p","No message yet. A topic without a subscriber may have none.","none");constructor(e,t,r){let[s,n,a]=[q("h3"),q("button","×"),q("div")];n.title=`Hide ${e}`,n.setAttribute("aria-label",n.title),n.addEventListener("click",()=>{this.box.remove(),r()});let o=q("span",e);o.title=t,s.append(o,n),this.box.append(s,this.note,this.table,a),this.curves=new ir(a,()=>{})}showMessage({time:e,fields:t,is_cut:r}){this.note.textContent=r?"The first fields of the message:":"",this.note.hidden=!r;for(let[s,n]of t){let a=this.samples.size===0;typeof n=="number"&&this.store(s,e,n),a&&this.samples.size&&this.selection.add(s);let o=this.rows.get(s)??this.row(s,typeof n=="number");o.value.textContent=typeof n=="number"?String(Number(n.toPrecision(6))):n??"–"}this.mark()}show(e){let t=[...this.samples].filter(([r])=>this.selection.has(r));this.curves.show(e,t.map(([,r])=>r))}store(e,t,r){let s=this.samples.get(e);s||this.samples.set(e,s={name:e,unit:"",times:[],values:[]}),!(t<=(s.times.at(-1)??-1))&&(s.times.push(t),s.values.push(r),!(s.times.length<=Kn)&&(s.times.splice(0,Kn/2),s.values.splice(0,Kn/2)))}row(e,t){let[r,s]=[q(t?"button":"div","","field"),q("output")];r.append(q("span",e),s),t&&(r.title="Show or hide its curve",r.addEventListener("click",()=>{this.selection.delete(e)||this.selection.add(e),this.mark()})),this.table.append(r);let n={row:r,value:s};return this.rows.set(e,n),n}mark(){for(let[e,{row:t}]of this.rows)t instanceof HTMLButtonElement&&t.setAttribute("aria-pressed",String(this.selection.has(e)))}};var ri=16,Fd=100,Cd=640,Jn=class{constructor(e,t,r,s){this.socket=e;this.pack=t;this.earlyEvents=r;this.isServerDrawn=s;e.onclose=()=>this.end("The simulation has ended.")}socket;pack;earlyEvents;isServerDrawn;pilot=new Hi((e,t)=>{this.send(e),t&&this.page?.picture.skipPauses()});topics=new as(e=>this.send({type:"topics",names:e}));page=null;stream=null;lastRequest="";imageNumbers=[];allowsReset=!1;begin(e,t){this.page=e,this.stream=t;for(let r of this.earlyEvents)this.receive(r);this.socket.onmessage=r=>this.receive(r),this.subscribe(e.switches.pictures)}subscribe(e){let t=e?this.pack.head.cameras.map(({name:r})=>r):[];this.send({type:"images",cameras:t,rate:10,width:this.page?.picture.pictureWidth()})}requestView({worldFromCamera:e,camera:t,intrinsics:r}){if(!this.isServerDrawn)return;let s=Math.min(1,Cd/r.width),[n,a]=[r.width,r.height].map(h=>Math.round(s*h)),o=ja(e).map(h=>Math.round(1e4*h)/1e4),l=2*Math.atan(r.height/2/r.fy),c={type:"view",camera:t?.name??null,pose:o,width:n,height:a,fovy:l},d=JSON.stringify(c);d!==this.lastRequest&&this.send(c),this.lastRequest=d}control(e,t){this.send({type:"control",action:e,...t===void 0?{}:{speed:t}})}handlePilotKey(e){return this.pilot.handlePilotKey(e)}helpGroups(){return{Pilot:this.pilot.help()}}send(e){this.socket.readyState===WebSocket.OPEN&&this.socket.send(JSON.stringify(e))}receive(e){let{page:t,stream:r}=this;if(!t||!r)return;if(typeof e.data=="string")return this.handleMessage(JSON.parse(e.data),t,r);let s=new DataView(e.data),[n,a]=[s.getUint8(0),s.getUint8(1)];n===0&&location.reload(),n===1&&r.push(s.getFloat64(8,!0),new Float32Array(e.data,ri)),n===2&&this.showImage(a,e.data.slice(ri),t,r),n===4&&r.setSand(a,new Float32Array(e.data,ri)),n===5&&this.addMedium(e.data.slice(ri),t,r),n===3&&this.isServerDrawn&&this.showView(e.data.slice(ri))}async addMedium(e,t,r){let s=await di(new Uint8Array(e));t.picture.media.add(s,s.head.optics),r.version+=1}handleMessage(e,t,r){if(e.type==="state")t.setState(e.paused,e.speed),this.allowsReset=e.resets,this.pilot.enable(e),t.views.follow(e.vehicle),t.keyboard.showHelp();else if(e.type==="levels")r.setLevels(e.levels);else if(e.type==="samples")for(let s of e.samples)r.sample(...s);else e.type==="readings"?r.version+=Number(t.quantities.setReadings(e.readings)):e.type==="topics"?this.topics.list(e.topics):e.type==="topic"?this.topics.showMessage(e):e.type==="markers"?r.setMarkers(e.markers):e.type==="end"&&this.end(e.why)}async showImage(e,t,r,s){let n=(this.imageNumbers[e]??0)+1;this.imageNumbers[e]=n;let a=await createImageBitmap(new Blob([t],{type:"image/jpeg"}));if(this.imageNumbers[e]!==n)return a.close();r.picture.show(e,a);let{end:o}=s;setTimeout(()=>{s.end===o&&(s.version+=1)},Fd)}showView(e){let t=N("stream");t.hidden=!1,Od(t,e)}end(e){N("message").textContent=e,this.page&&(this.page.isPlaying=!1)}};function Od(i,e){let t=i.src;i.src=URL.createObjectURL(new Blob([e],{type:"image/jpeg"})),t&&URL.revokeObjectURL(t)}function Cl(i){let e=location.protocol==="https:"?"wss:":"ws:",t=new WebSocket(`${e}//${location.host}/socket${location.search}`);return t.binaryType="arraybuffer",new Promise((r,s)=>{let n=[],a=!1;t.onerror=t.onclose=()=>s(new Error("The simulation cannot be reached.")),t.onmessage=o=>{let{data:l}=o;if(a||typeof l=="string"||new DataView(l).getUint8(0)!==0){n.push(o);return}a=!0,di(new Uint8Array(l.slice(ri))).then(c=>r(new Jn(t,c,n,i)),s)}})}var Nd=["clear","dusk","cloudy"],os=.03,ls=class{constructor(e){this.page=e;let t=N("view");document.addEventListener("keydown",r=>this.onKeyDown(r)),t.addEventListener("keydown",r=>this.turnView(r)),t.addEventListener("pointerdown",r=>{if(r.target.closest("button, .stick"))return;t.setPointerCapture(r.pointerId);let s=r.button!==0||r.shiftKey;this.dragState={x:r.clientX,y:r.clientY,isPan:s}}),t.addEventListener("pointermove",r=>this.drag(r)),t.addEventListener("pointerup",()=>this.dragState=null),t.addEventListener("pointercancel",()=>this.dragState=null),t.addEventListener("contextmenu",r=>r.preventDefault()),t.addEventListener("wheel",r=>{r.preventDefault(),e.views.zoom(Math.exp(.001*r.deltaY))},{passive:!1}),this.showHelp()}page;dragState=null;showHelp(){io(this.groups())}drag(e){if(!this.dragState)return;let t=N("view").clientHeight,[r,s]=[e.clientX-this.dragState.x,e.clientY-this.dragState.y];this.page.views.drag(r/t,s/t,this.dragState.isPan),Object.assign(this.dragState,{x:e.clientX,y:e.clientY})}turnView(e){let r={ArrowLeft:[os,0],ArrowRight:[-os,0],ArrowUp:[0,os],ArrowDown:[0,-os]}[e.key];!r||e.ctrlKey||e.altKey||e.metaKey||(e.preventDefault(),e.stopPropagation(),this.page.views.drag(r[0],r[1],e.shiftKey))}onKeyDown(e){let{page:t}=this;if(e.ctrlKey||e.altKey||e.metaKey)return;let r=e.target;if((r instanceof HTMLSelectElement||r instanceof HTMLInputElement)&&!/^[a-z?]$/.test(e.key)||e.key===" "&&r instanceof HTMLButtonElement||/^(Home|End)$/.test(e.key)&&N("help").contains(r)||t.connection?.handlePilotKey(e))return;let n=e.shiftKey?e.key.toLowerCase():e.key,a=this.actions()[n];a&&(e.preventDefault(),a())}actions(){let{page:e}=this,t=s=>()=>{let n=e.player.levels.findIndex(({trial:a,level:o})=>a===e.player.trial&&o.end>e.time);e.go(Math.max(0,(n<0?e.player.levels.length-1:n)+s))},r=s=>()=>{e.switches.sun=Nd[s],e.draw()};return{" ":()=>e.play(),",":()=>e.step(-1),".":()=>e.step(1),ArrowLeft:()=>e.seek(e.time-1),ArrowRight:()=>e.seek(e.time+1),Home:()=>e.seek(e.player.start),End:()=>e.seek(e.player.end),"[":t(-1),"]":t(1),"<":()=>e.changeSpeed(-1),">":()=>e.changeSpeed(1),o:()=>e.show("orbit"),b:()=>e.show("chase"),v:()=>e.show("camera"),m:()=>e.show("map"),p:()=>e.show("file"),z:()=>e.toggle("state"),h:()=>e.views.restoreInitial(),k:()=>e.views.toggleFollowing(),r:()=>e.reset(),"+":()=>e.views.zoom(.9),"=":()=>e.views.zoom(.9),"-":()=>e.views.zoom(1.1),x:()=>e.toggle("clear"),c:()=>e.toggle("pictures"),f:()=>e.toggle("frames"),l:()=>e.toggle("labels"),t:()=>e.toggle("trails"),y:()=>e.clearTrails(),s:()=>e.toggle("sonars"),n:()=>e.toggleTheme(),1:r(0),2:r(1),3:r(2),"?":Bi}}groups(){let{page:e}=this,t=e.connection?"reset vehicles and objects":"start of the level",r=[{keys:", .",action:"one row back, forward"},{keys:"← →",action:"one second back, forward (in the view: rotate it)"},{keys:"[ ]",action:"previous, next level"},{keys:"Home End",action:"start, end"}],s={Time:[{keys:"space",action:"play, pause"},...e.connection?[{keys:".",action:"one step"}]:r,{keys:"< >",action:"slower, faster"},...e.connection&&!e.connection.allowsReset?[]:[{keys:"r",action:t}]],View:[{keys:"o b v m",action:"orbit, behind the vehicle, next camera, map from above"},...e.pack.head.file_view?[{keys:"p",action:"the camera of the scene file"}]:[],{keys:"k",action:"orbit follows the vehicle, or stays"},{keys:"arrows, drag",action:"rotate; with Shift or the right button: move"},{keys:"+ -, wheel",action:"nearer, farther"},{keys:"h",action:"first view"},{keys:"x",action:"clear water, or the scene's fog"},{keys:"1 2 3",action:"clear sky, dusk, cloudy"}],Shown:[{keys:"c",action:"images of the cameras"},{keys:"z",action:"state of the vehicle; a click on a number draws its curve"},{keys:"f l",action:"frames, names"},{keys:"t y",action:"trails; restart them"},{keys:"s",action:"beams and fans of sonars"},{keys:"n",action:"light or dark colours"},{keys:"?",action:"these keys"}]};if(!e.connection)return s;let n=e.connection.pilot;for(let a of Object.values(s).flat())a.keys=a.keys.split(" ").map(o=>n.isReserved(o)?`Shift+${o}`:o).join(" ");return{...s,...e.connection.helpGroups()}}};function Nl({water:i,view:e}){let t=i.media?.[0];return t?Math.min(...t.absorption.map((s,n)=>s+t.scattering[n]))*Math.hypot(...e.at.map((s,n)=>s-e.pose[n]))>3:!0}var cs=class{entries=[];clearMedium;constructor(e){let{media:t,clear:r}=e.head.water;for(let s of t??[])this.add(e,s);this.clearMedium=r?Ol(e,r):null}add(e,t){this.entries.length>=64&&this.entries.splice(1,1),this.entries.push(Ol(e,t))}mediumAt(e){if(!this.entries.length)return null;let t=e.signal("beam_attenuation"),r=t===void 0?this.entries[0]:Dd(this.entries,t),s=e.signal("exposure_level");if(s===void 0)return r;let n=2**s/r.exposure;return{...r,exposure:2**s,clear_exposure:n*r.clear_exposure}}clearOptics(e){return e&&this.clearMedium&&{...this.clearMedium,exposure:e.clear_exposure}}};function Dd(i,e){let t=i.map(({absorption:r,scattering:s})=>Math.abs(r[1]+s[1]-e));return i[t.lastIndexOf(Math.min(...t))]}function Ol(i,e){let t=i.numbers(e.transform.values);return{...e,transform:{...e.transform,values:t}}}var Dl=200,Ul=5,Zn=6e3,Ud=1200,ea=180/Math.PI,fs=class{constructor(e,t){this.head=e;this.rays=t}head;rays;histories=new Map;readings=[];storeTime=-1/0;trial=-1;vehicle=0;setReadings(e){let t=JSON.stringify(e)!==JSON.stringify(this.readings);return this.readings=e,t}compute(e,t,r){this.vehicle=r;let s=this.readings.map(([n,a,o])=>({name:n,unit:a,value:o}));return[...this.motionQuantities(e,t),...s]}store(e,t){if(e<this.storeTime&&this.histories.clear(),!(e>=this.storeTime&&e<this.storeTime+1/Ul)){this.storeTime=e;for(let{name:r,unit:s,value:n}of t){let a=this.historyOf(r,s);a.times.push(e),a.values.push(n),!(a.times.length<=Zn)&&(a.times.splice(0,Zn/2),a.values.splice(0,Zn/2))}}}history({name:e,unit:t},r){if(r.isLive)return this.historyOf(e,t);r.trial!==this.trial&&this.histories.clear(),this.trial=r.trial;let s=this.histories.get(e);if(s)return s;let n=this.historyOf(e,t),a=r.end-r.start,o=Math.max(2,Math.min(Ud,Math.ceil(a*Ul)));for(let l=0;l<o;++l){let c=r.start+a*l/(o-1),d=this.motionQuantities(r.snapshot(c),r,e);n.times.push(c),n.values.push(d.find(h=>h.name===e)?.value??null)}return n}historyOf(e,t){let r=this.histories.get(e);return r||this.histories.set(e,r={name:us(e),unit:t,times:[],values:[]}),r}motionQuantities(e,t,r=""){let s=this.head.vehicles[this.vehicle];if(!s)return[];let n=Vl(this.head,e,s.body),[a,o,l]=ve(n),c=this.zAxisSign(s.body),d=Math.atan2(n[0],n[4])*ea,h=[{name:"depth",unit:"m",value:this.head.water.surface_height-l},{name:"heading",unit:"deg",value:Math.round(10*(d+360))/10%360},{name:"roll",unit:"deg",value:Math.atan2(c*n[9],c*n[10])*ea},{name:"pitch",unit:"deg",value:Math.asin(Math.max(-1,Math.min(1,n[8])))*ea},{name:"speed",unit:"m/s",value:t.speed(s.body,e.time)}];(!r||r==="altitude")&&h.splice(1,0,{name:"altitude",unit:"m",value:this.altitude([a,o,l],s.name,e)});let m=["x","y","z"].map(y=>e.signal(`water/${s.name}/${y}`)??0),v=Math.hypot(...m);return(v>=.005||r)&&h.push({name:"current",unit:"m/s",value:v}),h}zAxisSign(e){let t=this.head.bodies.find(({name:r})=>r===e);return t&&st(t.pose)[10]<0?-1:1}altitude(e,t,r){let s=Me(e,[0,0,-Dl]),n=o=>Vl(this.head,r,o),a=this.rays.cast(e,s,n,o=>o.vehicle===t);return a<1?a*Dl:null}};function Vl(i,e,t){let r=i.bodies.find(({name:s})=>s===t);return e.poses.get(t)??st(r?.pose??[0,0,0,1,0,0,0])}function us(i){let[e,t]=[i.split("/")[0],i.slice(i.indexOf("/")+1)];return t===i||e==="joint"||t.toLowerCase().includes(e)?t:`${t} ${e}`}var zl=100,Vd=["depth","speed"],zd={deg:"°",1:"×"},hs=class{constructor(e,t,r,s){this.quantities=e;this.player=t;this.redraw=s;this.curves=new ir(N("state"),r)}quantities;player;redraw;cells=new Map;selection=new Set;curves;hasSelection=!1;displayTime=0;isUpdatePending=!1;lastState=null;values=[];show(e,t,r){this.lastState=[e,t,r];let s=performance.now();s-this.displayTime>=zl||!this.player.isLive?(this.displayTime=s,this.values=this.quantities.compute(e,this.player,t),this.player.isLive&&this.quantities.store(e.time,this.values),this.values.forEach(o=>this.fill(o))):this.isUpdatePending||(this.isUpdatePending=!0,setTimeout(()=>{this.isUpdatePending=!1,this.show(...this.lastState)},zl)),N("hud").hidden=!r||!this.values.length,!this.hasSelection&&this.values.length&&this.selectInitial();let a=this.selectedCurves();N("state-box").hidden=!a.length,a.length&&this.curves.show(e.time,a)}redrawCurves(){this.curves.redraw()}selectInitial(){this.hasSelection=!0,this.player.isLive&&!this.player.curves.length&&!this.player.levels.length&&Vd.forEach(e=>this.selection.add(e)),this.mark()}selectedCurves(){return this.values.filter(({name:t})=>this.selection.has(t)).map(t=>this.quantities.history(t,this.player))}fill({name:e,unit:t,value:r}){let s=this.cells.get(e)??this.cell(e);s.value.textContent=Gd(r,t)}cell(e){let t=q("button","",e.startsWith("joint/")?"joint":""),r=q("output");t.append(q("span",us(e)),r),t.title=`${us(e)}: show or hide its curve`,t.addEventListener("click",()=>{this.selection.delete(e)||this.selection.add(e),this.hasSelection=!0,this.mark(),this.redraw()});let s={button:t,value:r};return this.cells.set(e,s),this.mark(),N("hud").append(t),s}mark(){for(let[e,{button:t}]of this.cells)t.setAttribute("aria-pressed",String(this.selection.has(e)))}};function Gd(i,e){if(i===null)return"–";let t={deg:1,m:2,"m/s":2,N:1,"%":0}[e]??2,r=i.toFixed(t).replace(/^-(0(\.0*)?)$/,"$1"),s=zd[e]??` ${e}`;return`${r.replace("-","−")}${s}`}var Bd={orbit:["Orbit","Orbit around the vehicle (o)"],chase:["Chase","From behind the vehicle (b)"],camera:["Camera","Image of a camera (v)"],map:["Map","From above, north up (m)"],file:["File","From the <camera> of the scene file (p)"]},Hd={clear:["Clear water","Water without fog (x)"],state:["State","Depth, heading, joints and more; a click on a number draws its curve (z)"],pictures:["Cameras","Images of the cameras (c)"],frames:["Frames","Coordinate frames with their names (f)"],trails:["Trails","Trails of bodies (t)"],sonars:["Sonars","Beams and fans (s)"]};function Gl(i,e,t){for(let s of e){let[n,a]=Bd[s],o=q("button",n);o.title=a,o.dataset.mode=s,o.setAttribute("role","radio"),o.addEventListener("click",()=>i.show(s)),N("modes").append(o)}let r=N("camera");t.forEach((s,n)=>r.append(new Option(s,String(n)))),r.addEventListener("change",()=>{i.views.camera=Number(r.value),i.refresh()})}function Bl(i){let{sensors:e,cameras:t,vehicles:r}=i.pack.head,s={sonars:e.length,pictures:t.length,state:r.length};for(let[n,[a,o]]of Object.entries(Hd)){if(s[n]===0)continue;let l=q("button",a);l.dataset.switch=n,l.title=o,l.addEventListener("click",()=>i.toggle(n)),N("switches").append(l)}}function Hl({views:i,switches:e,pack:t}){for(let s of N("modes").querySelectorAll("button"))s.setAttribute("aria-checked",String(s.dataset.mode===i.mode));for(let s of N("switches").querySelectorAll("button"))s.setAttribute("aria-pressed",String(e[s.dataset.switch]));let r=N("camera");r.hidden=i.mode!=="camera"||t.head.cameras.length<2,r.value=String(i.camera)}var Wl=["orbit","chase","camera","map","file"],Wd=.9,Yd=.4,ds=class{constructor(e,t,r){this.head=e;this.models=t;this.rays=r;this.orbit=ta(e.view),this.restoreInitial()}head;models;rays;mode="orbit";camera=0;version=0;vehicle=0;holdOffset=null;orbit;file=null;chaseAzimuth=0;height=12;mapOffset=[0,0];follow(e){e!==this.vehicle&&(this.vehicle=e,this.version+=1)}toggleFollowing(){this.holdOffset=this.holdOffset?null:this.displacement(),this.version+=1}restoreInitial(){this.version+=1,this.holdOffset=null,this.orbit=ta(this.head.view),this.file=this.head.file_view&&ta(this.head.file_view),this.chaseAzimuth=0,this.mapOffset.fill(0),this.height=Math.max(6,2*this.orbit.distance)}viewCamera(e,t){let{view:r,file_view:s}=this.head,n=Ka(e,t,(this.mode==="file"&&s?s:r).fovy),a=this.mode==="camera"?this.head.cameras[this.camera]:void 0;if(a){let l=ia(a,e,t);return{worldFromCamera:this.models.worldFromMount(a),intrinsics:l,isExternal:!1,camera:a}}let o;if(this.mode==="map"){let[l,c]=Me(this.centre(),[...this.mapOffset,0]);o=dn([l,c,this.centre()[2]+this.height],[l,c,this.centre()[2]],[0,1,0])}else if(this.mode==="chase"&&this.base()){let l=this.base(),c=Math.atan2(l[4],l[0])+Math.PI+this.chaseAzimuth;o=this.chasePose(c,Math.max(.15,this.orbit.elevation))}else if(this.mode==="file"&&this.file)o=wi(this.file);else{let l=Me(this.orbit.target,this.holdOffset??this.displacement());o=wi({...this.orbit,target:l})}return{worldFromCamera:o,intrinsics:n,isExternal:!0,camera:null}}drag(e,t,r){if(this.version+=1,this.mode==="map"||r)return this.move(e,t);this.mode==="chase"?this.chaseAzimuth-=4*e:this.activeView().azimuth-=4*e;let s=this.activeView();s.elevation=ra(s.elevation+3*t,-1.55,1.55)}zoom(e){this.version+=1,this.mode==="map"?this.height=ra(this.height*e,.5,2e3):this.activeView().distance=ra(this.activeView().distance*e,.1,2e3)}move(e,t){if(this.mode==="map"){let n=2*this.height*Math.tan(this.head.view.fovy/2);this.mapOffset[0]-=e*n,this.mapOffset[1]+=t*n;return}let r=this.activeView(),s=wi(r);r.target=Me(r.target,[s[0],s[4],s[8]],-e*r.distance),r.target=Me(r.target,[s[1],s[5],s[9]],t*r.distance)}activeView(){return this.mode==="file"&&this.file?this.file:this.orbit}chasePose(e,t){let r=this.centre(),{distance:s}=this.orbit,n=wi({target:r,azimuth:e,elevation:t,distance:s}),a=this.head.vehicles[this.vehicle].name,o=m=>this.models.body(m),l=.05*s,c=[[0,0],[l,0],[-l,0],[0,l],[0,-l]].map(([m,v])=>this.rays.cast(r,Ie(n,[m,v,0]),o,y=>y.vehicle===a)),d=Math.min(...c);if(d>=1)return n;let h=Math.max(Math.min(Yd,s),Wd*d*s);return wi({target:r,azimuth:e,elevation:t,distance:h})}base(){let e=this.head.vehicles[this.vehicle];return e?this.models.body(e.body):null}displacement(){let e=this.head.vehicles[this.vehicle],t=this.head.bodies.find(({name:r})=>r===e?.body);return t?Me(this.centre(),t.pose.slice(0,3),-1):[0,0,0]}centre(){let e=this.base();return e?Ie(e,[0,0,0]):this.head.view.at}};function ta(i){let e=Me(ve(st(i.pose)),i.at,-1),t=Math.hypot(...e);return{target:[...i.at],azimuth:Math.atan2(e[1],e[0]),elevation:Math.asin(e[2]/t),distance:t}}function wi({target:i,azimuth:e,elevation:t,distance:r}){let[s,n]=[Math.cos(t),Math.sin(t)],a=bt([s*Math.cos(e),s*Math.sin(e),n]);return dn(Me(i,a,r),i)}function ia(i,e,t){let r=Math.min(t/i.height,e/i.width);return{width:e,height:t,fx:i.fx*r,fy:i.fy*r,cx:(e-1)/2+(i.cx-(i.width-1)/2)*r,cy:(t-1)/2+(i.cy-(i.height-1)/2)*r,skew:i.skew*r,near:i.near,far:i.far}}function ra(i,e,t){return Math.min(t,Math.max(e,i))}var Yl=[.1,.25,.5,1,2,5,10,20],ms=class{constructor(e,t,r,s,n,a){this.pack=e;this.player=t;this.picture=r;this.views=s;this.connection=n;this.switches.clear=Nl(e.head),this.quantities=new fs(e.head,a),this.hud=new hs(this.quantities,t,o=>this.seek(o),()=>this.draw()),this.levels=new zi(t,o=>{this.go(o)}),this.thrusters=new Gi(e.head),this.keyboard=new ls(this),this.build(),requestAnimationFrame(o=>this.tick(o))}pack;player;picture;views;connection;time=0;isPlaying=!1;speed=1;switches={clear:!0,pictures:!0,state:!0,frames:!1,labels:!1,trails:!0,sonars:!0,sun:""};curves=new ir(N("curves"),e=>this.seek(e));quantities;hud;levels;thrusters;keyboard;lastTick=performance.now();drawnKey="";note="";async go(e){let t=this.player.levels[e];!t||this.connection||(await this.select(t.trial),this.seek(t.level.start))}async select(e){if(e===this.player.trial)return;await this.player.select(e),N("message").textContent=ro(this.player)?"This trial has no recorded motion.":this.note,this.curves.set(this.player.curves);let{start:t,end:r}=this.player;this.levels.mark(t,r),Object.assign(N("time"),{min:String(t),max:String(r)})}seek(e){this.connection||(this.time=Math.min(this.player.end,Math.max(this.player.start,e)),this.draw())}play(e=!this.isPlaying){this.isPlaying=e,e&&!this.connection&&this.time>=this.player.end-1e-6&&(this.time=this.player.start),this.connection?.control(e?"play":"pause"),N("play").textContent=e?"Pause":"Play"}step(e){this.play(!1),this.connection?this.connection.control("step"):this.seek(this.time+e/30)}reset(){this.connection?this.connection.control("reset"):this.seek(this.player.levels[gr(this.player,this.time)]?.level.start??this.player.start)}setSpeed(e,t=!0){this.speed=e;let r=N("speed");[...r.options].some(({value:s})=>s===String(e))||r.append(Xl(e)),r.value=String(e),t&&this.connection?.control("speed",e)}setState(e,t){this.isPlaying=!e,N("play").textContent=e?"Play":"Pause",this.setSpeed(t,!1)}changeSpeed(e){let t=n=>n||1/0,r=this.speeds().filter(n=>(t(n)-t(this.speed))*e>0),s=e>0?r[0]:r.at(-1);s!==void 0&&this.setSpeed(s)}speeds(){return this.connection?[...Yl,0]:Yl}show(e){this.modes().includes(e)&&(e==="camera"&&this.views.mode==="camera"&&(this.views.camera=(this.views.camera+1)%this.pack.head.cameras.length),this.views.mode=e,this.refresh())}modes(){let{cameras:e,file_view:t}=this.pack.head;return Wl.filter(r=>(r!=="camera"||e.length)&&(r!=="file"||t))}toggle(e){this.switches[e]=!this.switches[e],e==="frames"&&(this.switches.labels=this.switches.frames),this.connection?.subscribe(this.switches.pictures),this.refresh()}clearTrails(){this.player.clearTrails(this.time),this.draw()}toggleTheme(){let e=document.documentElement;e.dataset.theme=e.dataset.theme==="dark"?"light":"dark",this.curves.redraw(),this.hud.redrawCurves(),this.connection?.topics.redrawCurves()}draw(){this.player.isLive&&(this.time=this.player.end);let e=this.player.snapshot(this.time);this.hud.show(e,this.views.vehicle,this.switches.state);let t=this.picture.draw(this.player,e,this.views,this.switches);t&&this.connection?.requestView(t),this.levels.show(this.time),this.curves.show(this.time,this.player.curves),N("curves-box").hidden=!this.player.curves.length,this.connection?.topics.show(this.time),this.thrusters.show(e);let r=[...document.querySelectorAll("aside > section")];document.body.classList.toggle("bare",r.every(({hidden:s})=>s)),N("time").value=String(this.time),N("clock").textContent=this.player.isLive?`${this.time.toFixed(2)} s`:`${this.time.toFixed(2)} / ${this.player.end.toFixed(2)} s`}tick(e){requestAnimationFrame(o=>this.tick(o));let t=Math.min(.25,(e-this.lastTick)/1e3);this.lastTick=e,this.isPlaying&&!this.connection&&(this.time=Math.min(this.player.end,this.time+t*this.speed),this.time>=this.player.end&&this.play(!1));let{clientWidth:r,clientHeight:s}=this.picture.canvas,a=[this.time,this.player.end,r,s,this.views.version,this.player.version].join()+JSON.stringify(this.switches);a!==this.drawnKey&&!document.hidden&&this.picture.isReady()&&(this.drawnKey=a,this.draw())}refresh(){Hl(this),this.draw()}build(){Gl(this,this.modes(),this.pack.head.cameras.map(({name:r})=>r)),Bl(this);let e=N("speed");e.append(...this.speeds().map(Xl)),e.addEventListener("change",()=>this.setSpeed(Number(e.value))),this.setSpeed(1,!1);let t=N("time");t.addEventListener("input",()=>this.seek(Number(t.value))),N("play").addEventListener("click",()=>this.play()),N("step").addEventListener("click",()=>this.step(1)),N("back").addEventListener("click",()=>this.step(-1)),N("back").hidden=N("line").hidden=this.player.isLive,N("help-button").addEventListener("click",Bi),this.refresh()}};function Xl(i){return new Option(i?`${i}×`:"fastest",String(i))}var ps=class{constructor(e,t){this.pack=e;this.head=t}pack;head;trial=-1;current=null;surfaceAt(e,t){let{surface:r,trials:s}=this.head;if(!r)return null;if(!this.current||e!==this.trial){let n=s?.[e]?.surface??r;this.trial=e,this.current={waves:this.read(n.waves),ripples:this.read(n.ripples)}}return{...this.current,time:t.time,scale:t.signal("wave_scale")??r.scale}}read(e){if(!e)return null;let t=this.pack.numbers(e),r=t.length/5,[s,n,a,o,l]=[0,1,2,3,4].map(c=>t.subarray(r*c,r*(c+1)));return{amplitude:s,omega:n,kx:a,ky:o,phase:l}}};var gs=class{constructor(e,t){this.heap=e;this.positions=t;this.initialHeights=Float32Array.from({length:t.length/3},(r,s)=>t[3*s+2]-e.corner[2]),this.heights=this.initialHeights.slice()}heap;positions;heights;initialHeights;removals=[];lastHeights=null;set(e){return e===this.lastHeights?!1:(this.lastHeights=e,this.heights.set(e.subarray(0,this.heights.length)),!0)}apply(e){let t=this.removals,r=e.length>=t.length&&t.every((s,n)=>s===e[n]);if(r&&e.length===t.length)return!1;r||this.heights.set(this.initialHeights);for(let{position:s}of r?e.slice(t.length):e)s?this.remove(s):this.heights.set(this.initialHeights);return this.removals=e,!0}surface(){let{heap:e,heights:t}=this,[r,s]=e.columns,n=Float32Array.from(this.positions),a=new Int16Array(n.length),o=(l,c,d)=>{let[h,m]=[Math.max(0,l-1),Math.min(c-1,l+1)];return(d(m)-d(h))/((m-h)*e.cell)};for(let l=0;l<r;++l)for(let c=0;c<s;++c){let d=l*s+c,h=o(l,r,y=>t[y*s+c]),m=o(c,s,y=>t[l*s+y]),v=32767/Math.hypot(h,m,1);n[3*d+2]=e.corner[2]+t[d],a.set([-h*v,-m*v,v],3*d)}return{positions:n,normals:a}}remove([e,t,r]){let{heap:s,heights:n}=this,[a,o]=s.columns,l=s.reach**2,c=(y,w)=>[Math.max(0,Math.floor((y-s.reach)/s.cell)),Math.min(w-1,Math.ceil((y+s.reach)/s.cell))],[[d,h],[m,v]]=[c(e,a),c(t,o)];for(let y=d;y<=h;++y)for(let w=m;w<=v;++w){let x=y*o+w;(y*s.cell-e)**2+(w*s.cell-t)**2+(n[x]-r)**2<l&&(n[x]=Math.max(0,n[x]-s.bite))}}};var ql=`// Provides: pixels without a surface: the water's far colour, range inf, id 0.
// Needs: frame.glsl, grey.glsl, targets.glsl.
// The far colour is the limit of the water's image model at infinite distance.
#include "frame.glsl"
#include "grey.glsl"
#ifdef PHYSICAL
#include "optics.glsl"
#endif
#include "targets.glsl"

void main() {
#ifdef COLOUR
#ifdef PHYSICAL
    colour_out = vec4(0.0, 0.0, 0.0, FAR);
#else
    colour_out = vec4(camera_colour(background.rgb), 1.0);
#endif
#endif
#ifdef RANGE
    range_out = uintBitsToFloat(0x7f800000u);
#endif
#ifdef IDS
    id_out = 0u;
#endif
}
`;var jl=`// Provides: one triangle over the whole image at the far plane.
// Needs: nothing; three vertices without attributes.
// Depth 1 passes only where nothing has been drawn.
void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    gl_Position = vec4(corner, 1.0, 1.0);
}
`;var $l=`// Provides: the Gaussian of a level of blur along its columns, plus the wider levels; at the first level, plus the lamps' veil.
// Needs: gaussian.glsl; the level after its rows; with WIDER, the sum of the wider levels at half the resolution; with LAMPS,
// the number of lamps: optics.glsl, lamps.glsl, lamp_veil.glsl, and the mean light, whose alpha is the range. With VEIL_ONLY there
// is no level.
#include "gaussian.glsl"
uniform sampler2D level_0;
#ifdef WIDER
uniform sampler2D level_1;
#endif
#ifdef LAMPS
#include "optics.glsl"
#include "lamps.glsl"
#include "lamp_veil.glsl"
uniform sampler2D level_2;
#endif
out vec4 light_out;

void main() {
#ifdef VEIL_ONLY
    vec3 sum = vec3(0.0);
#else
    vec3 sum = gaussian(level_0, ivec2(0, 1)).rgb;
#endif
#ifdef WIDER
    sum += textureLod(level_1, gl_FragCoord.xy / (2.0 * vec2(textureSize(level_1, 0))), 0.0).rgb;
#endif
#ifdef LAMPS
    float range = texelFetch(level_2, ivec2(gl_FragCoord.xy), 0).a;
    vec2 pixel = 2.0 * gl_FragCoord.xy;
    vec3 ray = normalize(ray_first.xyz + pixel.x * ray_column.xyz + pixel.y * ray_row.xyz);
    for (int i = 0; i < LAMPS; ++i) sum += lamp_veil(i, ray, range);
#endif
    light_out = vec4(sum, 1.0);
}
`;var Kl=`// Provides: the Gaussian of a level of blur along its rows.
// Needs: gaussian.glsl; the texture of the level.
// blurred.frag.glsl adds that along the columns.
#include "gaussian.glsl"
uniform sampler2D level_0;
out vec4 light_out;

void main() {
    light_out = gaussian(level_0, ivec2(1, 0));
}
`;var Ql=`// Provides: caustic_excess(place, depth, depths, swell_frame), the gain of the sun's beam by the moving surface, minus 1.
// Needs: the maps of caustics/caustic_map.py; with SWELL the grid of caustics/swell.py; place: where the beam enters, in tiles.
// The light of one depth is interpolated between two maps. Above the first it is linear, and far below the last contrast falls.
uniform sampler2DArray caustic_maps;
#ifdef SWELL
uniform sampler2D swell_map;
#endif

#ifdef MAP_LEVEL
#define READ_MAP(place, index) textureLod(caustic_maps, vec3(place, index), map_level)
float caustic_excess(vec2 place, float depth, vec4 depths, vec4 frame, float map_level) {
#else
#define READ_MAP(place, index) texture(caustic_maps, vec3(place, index))
float caustic_excess(vec2 place, float depth, vec4 depths, vec4 frame) {
#endif
    float z = max(depth, 0.0);
    float density = 1.0;
#ifdef SWELL
    vec4 swell = textureLod(swell_map, place * frame.z + frame.xy, 0.0);
    vec2 inside = step(abs(place * frame.z + frame.xy - 0.5), vec2(0.5));
    density = 1.0 - z * (swell.z - z * swell.w) * inside.x * inside.y;
    place -= z * frame.w * swell.xy;
#endif
    float level = clamp(log2(max(z, depths.x)) * depths.y + depths.z, 0.0, float(N_SLICES - 1));
    float layer = step(0.5 * float(N_SLICES), level);  // of the maps 0 to 3, or 2 to 5
    vec4 shares = max(1.0 - abs(vec4(0.0, 1.0, 2.0, 3.0) + 2.0 * layer - level), 0.0);
    float excess = dot(READ_MAP(place, layer), shares);
    float far = depths.w / max(z, depths.w);
    return (1.0 + excess * min(z / depths.x, 1.0) * far * far) * density - 1.0;
}
`;var Jl=`// Provides: the block Caustics, the numbers of caustics that are constant in an image.
// Needs: nothing. Filled by caustics/caustic_light.py, where the same members are declared.
// A tile is the unit of length of maps.
layout(std140) uniform Caustics {
    vec4 caustic_x;       // place where the beam to a point in the camera frame enters: x of W = xyz * point + w [tiles]
    vec4 caustic_y;       // the same for y of W
    vec4 swell_frame;     // xy, z: coordinates in the grid of long waves = z * place + xy; w: tiles in a metre
    vec4 caustic_depths;  // x: first depth [m]; y, z: index of a map = y log2(depth) + z; w: last depth [m]
    vec4 caustic_loss;    // rgb: rate at which the contrast falls with depth [1/m]; w: greatest b p / (b* p*) in shafts on the way to the surface
    vec4 shaft_numbers;   // x: asymmetry of p*; y: b* / b; z: longest way [m]; w: texels in a tile
};
`;var Zl=`// Provides: daylight(facing, up_cosine, share, depth), the light of sun and sky under water; albedo_of(stored), a surface's albedo.
// Needs: varyings.glsl with PHYSICAL; facing = N.L; up_cosine = N.up; share = 0 in the sun's shadow to 1; depth below the surface [m].
// physical/daylight_field.py, physical/transfer_curve.py: the sun's beam, with CAUSTICS focused by waves; diffuse light from above, light from below.
#ifdef CAUSTICS
#include "caustics.glsl"
#endif
vec3 daylight(float facing, float up_cosine, float share, float depth) {
    float z = max(depth, 0.0);
    vec3 total = v_daylight_total * exp(v_daylight_loss * -z);
    vec3 level = min(v_sun_beam.rgb * exp(v_sun_loss * -z), total);
    vec3 diffuse = total - level;
#ifdef CAUSTICS
    level *= 1.0 + exp(v_caustic_loss * -z) * caustic_excess(v_caustic_place, depth, v_caustic_depths, v_swell_frame);
#endif
    return level * (max(facing, 0.0) * share / v_sun_beam.w)
        + diffuse * (0.5 + 0.5 * up_cosine) + v_upwelling * total * (0.5 - 0.5 * up_cosine);
}

vec3 albedo_of(vec3 stored) {
    vec3 root = sqrt(stored);
    return stored * (0.0982065878 + root * (-0.2653148210 + root * (0.7011382242 + root * (0.5186992531 - 0.0527292441 * root))));
}
`;var ec=`// Provides: the stored colours of an image through physical water: direct light, blur, veil, exposure, curve.
// Needs: optics.glsl, transmission.glsl, open_water.glsl, grey.glsl; the image of the surfaces; with SCATTERED, the sum of the
// levels; with PARTICLES, the image of the particles; with SHAFTS, the edge of a texel [px], that of the shafts; the switches BLUR,
// LINEAR for no curve, and LIGHT for no exposure either.
// B + D (J - B) + blur + veil: physical/development.py; the curve: physical/transfer_curve.py.
#include "optics.glsl"
#include "transmission.glsl"
#include "open_water.glsl"
#include "grey.glsl"
uniform sampler2D surface_image;
#ifdef SCATTERED
uniform sampler2D level_0;
#endif
#ifdef PARTICLES
uniform sampler2D particle_image;
#endif
#ifdef SHAFTS
uniform sampler2D shaft_image;
#endif
#ifdef CLOUDS
#include "clouds.glsl"
#include "cloud_edge.glsl"
uniform sampler2D cloud_layers_map;
uniform sampler2D cloud_lamplight_map;
uniform sampler2D cloud_daylight_map;

vec3 through_clouds(vec3 light, vec3 water, float range) {
    vec2 place = gl_FragCoord.xy / (float(CLOUD_EDGE) * vec2(textureSize(cloud_layers_map, 0)));
    vec4 layers = textureLod(cloud_layers_map, place, 0.0);
    vec4 lamplight = textureLod(cloud_lamplight_map, place, 0.0);
    vec3 daylight = textureLod(cloud_daylight_map, place, 0.0).rgb;
    vec4 shares = clamp((range - cloud_layers.x) / cloud_layers.y - vec4(0.0, 0.0, 1.0, 2.0), 0.0, 1.0);
    float depth = layers.x + dot(shares.yzw, layers.yzw - layers.xyz);
    vec3 mean = 1.0 / max(vec3(lamplight.a), 1e-6);
    vec3 veil = mean * lamplight.rgb * ((1.0 - exp(-LOSS_SHARE * depth)) / LOSS_SHARE);
    return mix(water + mean * daylight, light, exp(-depth)) + veil;
}
#endif
out vec4 colour_out;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    ivec2 size = textureSize(surface_image, 0);
    vec4 texel = texelFetch(surface_image, pixel, 0);
    vec3 water = open_water(gl_FragCoord.xy, vec2(size));
    vec3 light = water;
#ifdef PARTICLES
    vec4 particles = texelFetch(particle_image, pixel, 0);
    float seen = 1.0 - min(particles.a, 1.0);
#else
    const float seen = 1.0;
#endif
#ifdef SHAFTS
    light += seen * textureLod(shaft_image, gl_FragCoord.xy / (float(SHAFTS) * vec2(textureSize(shaft_image, 0))), 0.0).rgb;
#endif
    float is_surface = texel.a < 0.5 * FAR ? 1.0 : 0.0;
    float range = texel.a * is_surface;
    vec3 excess = (texel.rgb - water) * is_surface;
#ifdef BLUR
    vec3 sharp = direct(range) + weight(0, range);
#else
    vec3 sharp = whole_field(range);
#endif
#ifdef PARTICLES
    excess *= seen;
    light += particles.rgb;
#endif
    light += sharp * excess;
#ifdef SCATTERED
    vec3 scattered = textureLod(level_0, gl_FragCoord.xy / (2.0 * vec2(textureSize(level_0, 0))), 0.0).rgb;
#ifdef PARTICLES
    // what dark surfaces take from the water is behind the particles; the veil is mostly in front of them
    scattered = max(scattered, 0.0) + seen * min(scattered, 0.0);
#endif
    light += scattered;
#endif
#ifdef CLOUDS
    light = through_clouds(light, water, is_surface > 0.5 ? range : FAR);
#endif
#ifdef LIGHT
    colour_out = vec4(light, 1.0);
#else
    vec3 value = clamp(light * camera.y, 0.0, 1.0);
#ifndef LINEAR
    vec3 second = sqrt(value);
    vec3 fourth = sqrt(second);
    vec3 curve = 0.642363 * second + 0.71211342 * fourth - 0.33687116 * sqrt(fourth) - 0.01756212 * value;
    value = mix(12.92 * value, curve, step(0.0031308, value));
#endif
    colour_out = vec4(camera_colour(value), 1.0);
#endif
}
`;var tc=`// Provides: the block Frame: values that are constant in an image.
// Needs: nothing. Filled by frame.py, where the same members are declared.
// Camera frame: OpenGL axes (x right, y up, -z ahead), metres.
layout(std140) uniform Frame {
    mat4 clip_from_camera;
    mat4 shadow_from_camera;  // to texture coordinates and depth, 0..1
    vec4 up;                  // xyz: W's z axis, camera frame; w: camera's height above the water [m]
    vec4 sun;                 // xyz: towards the sun, camera frame; w: offset along normals against self-shadowing [m]
    vec4 sunlight;            // rgb: colour of the sun times the light rate
    vec4 ambient_specular;    // x: ambient, y: specular brightness, both times the light rate
    vec4 water_colour;        // rgb: colour of in-scattered light
    vec4 attenuation;         // rgb [1/m]
    vec4 fog;                 // rgb: colour; w: density squared [1/m2]
    vec4 clip_fog;            // clip-space z, the distance in UWSim's fog = x * planar depth + y [m]
    vec4 background;          // rgb: colour of pixels without a surface
};
`;var rc=`// Provides: gaussian(level, step), the Gaussian of a level at this texel along step, (1, 0) or (0, 1).
// Needs: the switches RADIUS [texels] and SPREAD, a thousand times the standard deviation [texels].
// Outside the level its edge is continued.
vec4 gaussian(sampler2D level, ivec2 step_) {
    ivec2 last = textureSize(level, 0) - 1;
    ivec2 texel = ivec2(gl_FragCoord.xy);
    vec4 sum = texelFetch(level, texel, 0);
#if RADIUS > 0
    const float rate = 500000.0 / (float(SPREAD) * float(SPREAD));
    float total = 1.0;
    for (int i = 1; i <= RADIUS; ++i) {
        float weight = exp(-rate * float(i * i));
        sum += weight * (texelFetch(level, clamp(texel - i * step_, ivec2(0), last), 0)
            + texelFetch(level, clamp(texel + i * step_, ivec2(0), last), 0));
        total += 2.0 * weight;
    }
    sum /= total;
#endif
    return sum;
}
`;var ic=`// Provides: camera_colour(colour), the colour of a pixel in the image of a colour or grey camera.
// Needs: nothing.
// With the switch GREY: int(0.2989 R) + int(0.5870 G) + int(0.1140 B) of 8-bit values, as in grey.py. Only the viewer's page sets it.
vec3 camera_colour(vec3 colour) {
#ifdef GREY
    vec3 stored = floor(clamp(colour, 0.0, 1.0) * 255.0 + 0.5);
    vec3 terms = floor(stored * vec3(0.2989, 0.5870, 0.1140) + 5e-5);
    return vec3((terms.r + terms.g + terms.b) / 255.0);
#else
    return colour;
#endif
}
`;var sc=`// Provides: the block Instance: the pose of one instance in the camera frame, and its id.
// Needs: nothing. Filled by instance.py, where the same members are declared.
// camera_normals is the inverse transpose of camera_from_model (scale may be uneven).
layout(std140) uniform Instance {
    mat4 camera_from_model;
    mat4 camera_normals;
    uvec4 identity;  // x: id, 1..65535
};
`;var nc=`// Provides: the radiance of a lamp that the camera sees, and its range.
// Needs: optics.glsl, targets.glsl with COLOUR; the outputs of lamp_point.vert.glsl. The renderer adds radiance and replaces range.
// pi I lobe / (d^2 Omega) with the solid angle Omega of a pixel, divided among the four pixels around the lamp.
#include "optics.glsl"
#include "targets.glsl"
flat in vec3 v_position;
flat in vec3 v_axis;
flat in vec4 v_light;
flat in float v_steepness;

void main() {
    float range = max(length(v_position), 0.01);
    float cosine = dot(v_axis, v_position) / range;
    float share = v_light.w > -1.0 ? clamp((cosine - v_light.w) * v_steepness, 0.0, 1.0) : 1.0;
    vec2 slope = v_position.xy / -v_position.z - ray_first.xy;
    float row = slope.y / ray_row.y;
    float column = (slope.x - row * ray_row.x) / ray_column.x;
    vec2 weight = max(1.0 - abs(gl_FragCoord.xy - vec2(column, row)), 0.0);
    float part = weight.x * weight.y * share * share * (3.0 - 2.0 * share);
    if (part <= 0.0) discard;
    float axis_cosine = -v_position.z / range;
    float solid_angle = axis_cosine * axis_cosine * axis_cosine * abs(ray_column.x * ray_row.y);
    colour_out = vec4(v_light.rgb * (3.14159265 * part / (range * range * solid_angle)), range);
}
`;var ac=`// Provides: a point of 3 x 3 pixels where the camera sees a lamp.
// Needs: frame.glsl, lamps.glsl with LAMPS; a vertex for each lamp, without attributes.
// The depth is that of a point 0.1 m nearer, so that a lamp's own housing does not hide it.
#include "frame.glsl"
#include "lamps.glsl"
flat out vec3 v_position;  // of the lamp, camera frame [m]
flat out vec3 v_axis;
flat out vec4 v_light;     // rgb: intensity times colour; w: cosine at the edge of the cone
flat out float v_steepness;

void main() {
    int i = gl_VertexID;
    v_position = lamp_position[i].xyz;
    v_axis = lamp_axis[i].xyz;
    v_light = vec4(lamp_light[i].rgb, lamp_position[i].w);
    v_steepness = lamp_axis[i].w;
    gl_Position = clip_from_camera * vec4(v_position, 1.0);
    float range = max(length(v_position), 1e-3);
    vec4 nearer = clip_from_camera * vec4(v_position * max(1.0 - 0.1 / range, 0.5), 1.0);
    if (gl_Position.w > 0.0 && nearer.w > 0.0) gl_Position.z = nearer.z / nearer.w * gl_Position.w;
    gl_PointSize = 3.0;
}
`;var oc=`// Provides: lamp_veil(i, ray, range), the light of a lamp that the water scatters into the camera along a unit ray.
// Needs: optics.glsl, lamps.glsl with LAMPS. optics/lamp_light.py has the formulas; no shadows.
// With u = tan(pi/4 + eta/2): cos(eta) = 2u / (1 + u^2), sin(eta) = (u^2 - 1) / (1 + u^2), t + d = t0 + h u.
vec3 veil_sample(float u, float weight, float foot, float height, float foot_axis, float ray_axis, int i, vec3 loss) {
    u = u >= 0.0 ? min(u, 1e5) : 1e5;  // rounding at far points of the ray
    float square = u * u;
    float inverse = 1.0 / (1.0 + square);
    float cosine = 2.0 * u * inverse;
    float sine = 1.0 - 2.0 * inverse;
    float share = clamp((foot_axis * cosine + ray_axis * sine - lamp_position[i].w) * lamp_axis[i].w, 0.0, 1.0);
    float q = sqrt(sqrt(square * inverse));
    vec4 even = phase_high;
    float log_phase = even.w;
    log_phase = log_phase * q + even.z;
    log_phase = log_phase * q + even.y;
    log_phase = log_phase * q + even.x;
    log_phase = log_phase * q + phase_low.w;
    log_phase = log_phase * q + phase_low.z;
    log_phase = log_phase * q + phase_low.y;
    log_phase = log_phase * q + phase_low.x;
    return exp(log_phase - loss * (foot + height * u)) * (weight * share * share * (3.0 - 2.0 * share));
}

vec3 lamp_veil(int i, vec3 ray, float range) {
    vec3 to_lamp = lamp_position[i].xyz;
    vec3 axis = -lamp_axis[i].xyz;
    float foot = dot(ray, to_lamp);
    vec3 foot_vector = foot * ray - to_lamp;
    float height = max(length(foot_vector), 1e-3);
    float begin = 0.0;
    float end = range;
    float ray_axis = dot(ray, axis);
    if (lamp_optics[i].w > 0.5) {
        // A t^2 + 2 B t + C >= 0 is the inside of the cone and of its mirror image behind the lamp.
        float origin = -dot(to_lamp, axis);
        float a = ray_axis * ray_axis - lamp_optics[i].z;
        a = abs(a) < 1e-7 ? 1e-7 : a;
        float b = ray_axis * origin + lamp_optics[i].z * foot;
        float c = origin * origin - lamp_optics[i].z * dot(to_lamp, to_lamp);
        float discriminant = b * b - a * c;
        float root = sqrt(max(discriminant, 0.0));
        float first = (-b - root) / a;
        float second = (-b + root) / a;
        float near = min(first, second);
        float far = max(first, second);
        bool is_lit = true;
        if (a > 0.0) {
            begin = ray_axis > 0.0 ? max(far, 0.0) : 0.0;
            end = ray_axis > 0.0 ? end : min(end, near);
        } else {
            is_lit = discriminant > 0.0 && origin + 0.5 * (near + far) * ray_axis > 0.0;
            begin = max(near, 0.0);
            end = min(end, far);
        }
        if (!is_lit || end <= begin) return vec3(0.0);
    }
    // Light that a lamp sends to the camera and the water scatters forward is in the blur of the lamp's own image.
    float cosine = dot(lamp_axis[i].xyz, to_lamp) / max(length(to_lamp), 1e-3);
    float direct_share = lamp_position[i].w > -1.0 ? clamp((cosine - lamp_position[i].w) * lamp_axis[i].w, 0.0, 1.0) : 1.0;
    begin = max(begin, mix(begin, foot, direct_share));
    if (end <= begin) return vec3(0.0);
    float low = atan((begin - foot) / height);
    float high = atan((end - foot) / height);
    float half_width = 0.25 * (high - low);
    float middle = tan(0.78539816 + 0.25 * (high + low));
    float inner = tan(0.3399810435848563 * half_width);
    float outer = tan(0.8611363115940526 * half_width);
    float foot_axis = dot(foot_vector, axis) / height;
    vec3 loss = absorption.rgb + 0.03 * scattering.rgb;  // c - 0.97 b
    vec3 sum = veil_sample(max(middle - outer, 0.0) / (1.0 + middle * outer), 0.3478548451374538, foot, height, foot_axis, ray_axis, i, loss)
        + veil_sample(max(middle - inner, 0.0) / (1.0 + middle * inner), 0.6521451548625461, foot, height, foot_axis, ray_axis, i, loss)
        + veil_sample((middle + inner) / (1.0 - middle * inner), 0.6521451548625461, foot, height, foot_axis, ray_axis, i, loss)
        + veil_sample((middle + outer) / (1.0 - middle * outer), 0.3478548451374538, foot, height, foot_axis, ray_axis, i, loss);
    return scattering.rgb * lamp_light[i].rgb * sum * (6.283185307 * half_width / height);  // pi b I (high - low) / 2 / h
}
`;var lc=`// Provides: lamplight(colour, unit_normal), the light of the lamps that a surface reflects.
// Needs: varyings.glsl and lamps.glsl with LAMPS; their shadow maps, four tiles of one texture.
// With MICROFACET, material.glsl replaces the colour.
// colour k I max(N.D, 0) / d^2 cone exp(-a d) * share of the light that no body blocks: see lamp.py.
uniform sampler2DShadow lamp_maps;

vec3 lamplight(vec3 colour, vec3 unit_normal) {
    vec3 sum = vec3(0.0);
    for (int i = 0; i < LAMPS; ++i) {
        vec3 towards = lamp_position[i].xyz - v_position;
        float distance = max(length(towards), 0.01);
        float facing = dot(unit_normal, towards) / distance;
        float cosine = dot(lamp_axis[i].xyz, towards) / distance;
        float cone_position = clamp((cosine - lamp_position[i].w) * lamp_axis[i].w, 0.0, 1.0);
        if (facing > 0.0 && cone_position > 0.0) {
            float cone = cone_position * cone_position * (3.0 - 2.0 * cone_position);
            float share = 1.0;  // a lamp that shines in all directions casts no shadows
            if (lamp_position[i].w > -1.0)
                share = textureLod(lamp_maps, v_lamp_uv[i].xyz / v_lamp_uv[i].w, 0.0);
#ifdef PHYSICAL
            // c - b e of a wide target, as optics/lamp_light.py has it for the way there
            vec3 energy = lamp_optics[i].x - lamp_optics[i].y * sqrt(absorption.rgb * (2.0 * distance));
            vec3 transmission = exp((absorption.rgb + scattering.rgb * (1.0 - energy)) * -distance);
#else
            vec3 transmission = exp(v_attenuation * -distance);
#endif
            vec3 arriving = lamp_light[i].rgb * transmission * (facing * cone * share / (distance * distance));
#ifdef MICROFACET
            arriving *= reflected_share(unit_normal, towards / distance, facing);
#endif
            sum += arriving;
        }
    }
#ifdef MICROFACET
    return sum;
#else
    return colour * sum;
#endif
}
`;var cc=`// Provides: the block Lamps: the lamps of the vehicles.
// Needs: the switch LAMPS, the number of lamps, 1..4. Filled by lamps.py, where the same members are declared.
// Camera frame: OpenGL axes, metres.
layout(std140) uniform Lamps {
    mat4[4] lamp_from_camera;  // to homogeneous texture coordinates and depth in the shadow maps
    vec4[4] lamp_position;     // xyz [m]; w: cosine at the edge of the cone
    vec4[4] lamp_axis;         // xyz: opposite to the beam; w: factor from cosines inside the edge to 0..1
    vec4[4] lamp_light;        // rgb: intensity times colour; w: offset along normals against self-shadowing, per metre of distance [1]
};
`;var fc=`// Provides: with NORMAL_MAP, mapped_normal(unit_normal); with MICROFACET, prepare_material, material_daylight, reflected_share.
// Needs: varyings.glsl; with MICROFACET: daylight.glsl, the table of reflectance.py, and with FINISH_MAP a map of occlusion, roughness, metal.
// pi times the BRDF of a rough surface: Lambert under a layer of GGX's microfacets: reflectance.py.
#ifdef NORMAL_MAP
uniform sampler2D normal_map;

vec3 mapped_normal(vec3 unit_normal) {
    vec3 local = texture(normal_map, v_uv).xyz * (255.0 / 127.5) - 1.0;
    vec3 outward = gl_FrontFacing ? unit_normal : -unit_normal;
    vec3 across = cross(outward, v_tangent.xyz) * v_tangent.w;
    vec3 mapped = v_finish.z * (local.x * v_tangent.xyz + local.y * across) + local.z * outward;
    mapped *= inversesqrt(max(dot(mapped, mapped), 1e-12));
    return gl_FrontFacing ? mapped : -mapped;
}
#endif
#ifdef MICROFACET
#define MIN_ROUGHNESS 0.08  // these are the constants of reflectance.py; the indices are squared and relative to the medium
#define WATER_INDEX 1.2530631
#define AIR_INDEX 2.25
uniform sampler2D reflectance_table;
#ifdef FINISH_MAP
uniform sampler2D finish_map;
#endif
vec3 surface_view;      // towards the camera
vec3 surface_diffuse;   // albedo below the layer, times the light that passes the layer
vec3 surface_metal;     // colour of metal
vec3 surface_gain;      // factor on its reflection for light that microfacets reflect several times
vec4 surface_finish;    // x: roughness; y: share of metal; z: squared width; w: n.v
vec2 surface_factors;   // x: squared relative index of a dielectric; y: share of the diffuse daylight that arrives
vec3 surface_mirror;    // reflectance of the layer under even light

// Fresnel's reflectance of a dielectric, or Schlick's of a metal, from the cosine of incidence.
vec3 fresnel(float cosine) {
    float g = sqrt(surface_factors.x - 1.0 + cosine * cosine);
    float minus = g - cosine;
    float plus = g + cosine;
    float ratio = minus / plus;
    float second = (cosine * plus - 1.0) / (cosine * minus + 1.0);
    float dielectric = 0.5 * ratio * ratio * (1.0 + second * second);
    float rest = 1.0 - cosine;
    float power = rest * rest;
    power *= power * rest;
    return mix(vec3(dielectric), surface_gain * (surface_metal + (1.0 - surface_metal) * power), surface_finish.y);
}

// Set the variables above for a pixel; call it before the functions below.
void prepare_material(vec3 albedo, vec3 normal, float depth) {
    float roughness = v_finish.x;
    float metallic = v_finish.y;
    float occlusion = 1.0;
#ifdef FINISH_MAP
    vec3 finish_texel = texture(finish_map, v_uv).rgb;
    occlusion = finish_texel.r;
    roughness *= finish_texel.g;
    metallic *= finish_texel.b;
#endif
    roughness = max(roughness, MIN_ROUGHNESS);
    float width = roughness * roughness;
    surface_view = -v_position * inversesqrt(dot(v_position, v_position));
    float nv = clamp(dot(normal, surface_view), 0.001, 1.0);
    vec2 texels = vec2(textureSize(reflectance_table, 0));
    vec3 table = textureLod(reflectance_table, (vec2(nv, roughness) * (texels - 1.0) + 0.5) / texels, 0.0).rgb;
    bool is_wet = depth > 0.0;
    float dielectric = is_wet ? table.g : table.b;
    surface_finish = vec4(roughness, metallic, width * width, nv);
    surface_factors = vec2(is_wet ? WATER_INDEX : AIR_INDEX, occlusion);
    surface_metal = albedo;
    surface_diffuse = albedo * ((1.0 - metallic) * (1.0 - dielectric));
    surface_gain = 1.0 + albedo * (1.0 / table.r - 1.0);
    surface_mirror = mix(vec3(dielectric), albedo * table.r * surface_gain, metallic);
}

// The share of a beam that the camera receives, pi times the BRDF; facing = normal . towards > 0.
vec3 reflected_share(vec3 normal, vec3 towards, float facing) {
    vec3 middle = towards + surface_view;
    middle *= inversesqrt(max(dot(middle, middle), 1e-12));
    float nh = dot(normal, middle);
    float square = surface_finish.z;
    float nv = surface_finish.w;
    float nl = max(facing, 1e-4);
    float peak = nh * nh * (square - 1.0) + 1.0;
    float shadowing = nl * sqrt(nv * nv * (1.0 - square) + square) + nv * sqrt(nl * nl * (1.0 - square) + square);
    float facets = 0.5 * square / (peak * peak * shadowing);
    return surface_diffuse + facets * fresnel(clamp(dot(surface_view, middle), 0.0, 1.0));
}

// The light of sun and sky that the surface reflects; the arguments are those of daylight.
vec3 material_daylight(vec3 normal, float facing, float upward, float share, float depth) {
    vec3 even = daylight(0.0, upward, share, depth);
    vec3 beam = daylight(1.0, upward, share, depth) - even;
    float mirrored_up = 2.0 * dot(normal, surface_view) * upward - dot(surface_view, v_up);
    float lobe = clamp(mirrored_up / surface_finish.x, -1.0, 1.0);
    vec3 mirrored = daylight(0.0, lobe, share, depth);
    vec3 total = surface_factors.y * (even * surface_diffuse + mirrored * surface_mirror);
    if (facing > 0.0) total += beam * (facing * reflected_share(normal, v_sun, facing));
    return total;
}
#endif
`;var uc=`// Provides: open_water(pixel, size), the radiance of open water behind a pixel; pixel counts as gl_FragCoord does.
// Needs: the small texture of physical/open_water_map.py.
// Its outer texels are at the image's corners.
uniform sampler2D open_water_map;

vec3 open_water(vec2 pixel, vec2 size) {
    vec2 texels = vec2(textureSize(open_water_map, 0));
    return textureLod(open_water_map, (pixel / size * (texels - 1.0) + 0.5) / texels, 0.0).rgb;
}
`;var hc=`// Provides: the block Optics, the numbers of physical water; and FAR, the range of pixels without a surface.
// Needs: nothing. Filled by physical/optics_block.py, where the same members are declared.
// Rays are in the camera frame (OpenGL axes), with z = -1, linear in gl_FragCoord.
#ifndef FAR
#define FAR 1e9
#endif
layout(std140) uniform Optics {
    vec4 absorption;       // rgb: a [1/m]; w: e0 of the whole field
    vec4 scattering;       // rgb: b [1/m]; w: k of the whole field
    vec4[2] reach;         // factors on the ranges of the levels of blur: blur_plan.py
    vec4 camera;           // y: exposure; z: middle range of the table of weights [m]
    vec4 sun_beam;         // rgb: irradiance of a level surface just below the surface by the sun
    vec4 sun_loss;         // rgb: its attenuation over depth [1/m]
    vec4 daylight_total;   // rgb: irradiance of a level surface just below the surface
    vec4 daylight_loss;    // rgb: its attenuation over depth [1/m]
    vec4 upwelling;        // rgb: share of the irradiance that comes up; w: cosine of the sun from the zenith
    vec4 phase_low;        // ln p as a polynomial of ((1 - cos) / 2)^(1/4): the lower four coefficients
    vec4 phase_high;       // the higher four
    vec4 ray_first;        // the ray at gl_FragCoord = 0
    vec4 ray_column;       // its change from column to column
    vec4 ray_row;          // its change from row to row
    vec4[4] lamp_optics;   // x: EE(half angle) - A; y: k_L; z: squared cosine of the half angle; w: 1 if it is below 90 degrees
};
`;var dc=`// Provides: projected(dry, colour, unit_normal), the light of a surface with the projected pattern.
// Needs: varyings.glsl and projector.glsl with PROJECTOR; the textures of the pattern and of the shadow map.
// A laser replaces the light by the pattern's colour, 0 or 1 in each channel, times exp(-a d). A lamp adds
// colour p max(N.D, 0) / d^2 exp(-a d) * share of the light that no body blocks: see projector.py.
uniform sampler2DShadow projector_map;
uniform sampler2D projector_pattern;

vec3 projected(vec3 dry, vec3 colour, vec3 unit_normal) {
    vec3 map_point = v_projector_uv.xyz / v_projector_uv.w;
    vec3 towards = projector_position.xyz - v_position;
    float distance = max(length(towards), 0.01);
    float facing = dot(unit_normal, towards) / distance;
    vec2 outside = step(0.5, abs(map_point.xy - 0.5));
    if (v_projector_uv.w <= 0.1 || facing <= 0.0 || outside.x + outside.y > 0.0) return dry;
    vec4 pattern = textureLod(projector_pattern, map_point.xy, 0.0);
    if (pattern.a < 0.5) return dry;
    float share = textureLod(projector_map, vec3(map_point.xy, min(map_point.z, 1.0)), 0.0);
    vec3 transmission = exp(v_attenuation * -distance);
    if (projector_position.w < 0.5)
        return dry + colour * pattern.rgb * transmission * (share * facing / (distance * distance));
    vec3 beam = step(0.5, pattern.rgb);
    float channels = beam.r + beam.g + beam.b;
    bool is_white = min(pattern.r, min(pattern.g, pattern.b)) >= 1.0;
    return share < 0.5 || channels < 0.5 || is_white ? dry : beam * transmission;
}
`;var mc=`// Provides: the block Projector: the projector of a pattern.
// Needs: nothing. Filled by projector_light.py, where the same members are declared.
// Camera frame: OpenGL axes, metres.
layout(std140) uniform Projector {
    mat4 projector_from_camera;  // to homogeneous texture coordinates and depth in the shadow map
    vec4 projector_position;     // xyz [m]; w: 1 laser, 0 lamp
    vec4 projector_axis;         // xyz: opposite to the beam; w: offset along normals against self-shadowing, per metre of distance [1]
};
`;var pc=`// Provides: the levels of blur after the second, each at half the resolution: texels weighed by 1, 3, 3, 1 along rows and columns.
// Needs: the textures of the levels; the switch N_LEVELS, how many there are, 1 to 6.
// Four linear look-ups are the sixteen weights; those outside the level have none.
uniform sampler2D level_0;
uniform sampler2D level_1;
uniform sampler2D level_2;
uniform sampler2D level_3;
uniform sampler2D level_4;
uniform sampler2D level_5;
layout(location = 0) out vec4[N_LEVELS] level_out;

vec4 smooth_mean(sampler2D level) {
    vec2 size = vec2(textureSize(level, 0));
    vec2 low = (2.0 * gl_FragCoord.xy - 0.75) / size;
    vec2 high = low + 1.5 / size;
    vec2 inside = step(high, vec2(1.0));
    vec4 sum = textureLod(level, low, 0.0) + inside.x * inside.y * textureLod(level, high, 0.0)
        + inside.y * textureLod(level, vec2(low.x, high.y), 0.0)
        + inside.x * textureLod(level, vec2(high.x, low.y), 0.0);
    return sum / ((1.0 + inside.x) * (1.0 + inside.y));
}

void main() {
    level_out[0] = smooth_mean(level_0);
#if N_LEVELS > 1
    level_out[1] = smooth_mean(level_1);
#endif
#if N_LEVELS > 2
    level_out[2] = smooth_mean(level_2);
#endif
#if N_LEVELS > 3
    level_out[3] = smooth_mean(level_3);
#endif
#if N_LEVELS > 4
    level_out[4] = smooth_mean(level_4);
#endif
#if N_LEVELS > 5
    level_out[5] = smooth_mean(level_5);
#endif
}
`;var gc=`// Provides: the light that levels of blur scatter, w_l (J - B), before their Gaussians.
// Needs: optics.glsl, transmission.glsl, open_water.glsl; the image of the surfaces; the switch N_LEVELS.
// The first run is at half the resolution and for one level; its last output is the mean of J - B, with the mean range as alpha, or FAR.
// The second run has the switch WIDE: it is twice as coarse, for all other levels, and reads that mean.
// J: radiance of a surface without water, B: of open water behind it. Pixels without a surface scatter nothing.
#include "optics.glsl"
#include "transmission.glsl"
#include "open_water.glsl"
uniform sampler2D surface_image;
#ifdef WIDE
#define FIRST 1
layout(location = 0) out vec4[N_LEVELS] level_out;
#else
#define FIRST 0
layout(location = 0) out vec4[N_LEVELS + 1] level_out;
#endif

vec4 scattered(int level, float range, vec3 excess) {
    return vec4(weight(1 + level, reach[level / 4][level % 4] * range) * excess, 0.0);
}

void main() {
    ivec2 size = textureSize(surface_image, 0);
    ivec2 corner = 2 * ivec2(gl_FragCoord.xy);
    vec3 sum = vec3(0.0);
    float ranges = 0.0;
    float count = 0.0;
    for (int i = 0; i < 4; ++i) {
        vec4 texel = texelFetch(surface_image, min(corner + ivec2(i % 2, i / 2), size - 1), 0);
        float is_surface = texel.a < 0.5 * FAR ? 1.0 : 0.0;
        sum += texel.rgb * is_surface;
        ranges += texel.a * is_surface;
        count += is_surface;
    }
    float range = ranges / max(count, 1.0);
#ifndef WIDE
    sum -= count * open_water(2.0 * gl_FragCoord.xy, vec2(size));
#endif
    vec3 excess = sum / 4.0;
    // no loop: WebGL's outputs have constant indices
#if N_LEVELS > 0
    level_out[0] = scattered(FIRST + 0, range, excess);
#endif
#if N_LEVELS > 1
    level_out[1] = scattered(FIRST + 1, range, excess);
#endif
#if N_LEVELS > 2
    level_out[2] = scattered(FIRST + 2, range, excess);
#endif
#if N_LEVELS > 3
    level_out[3] = scattered(FIRST + 3, range, excess);
#endif
#if N_LEVELS > 4
    level_out[4] = scattered(FIRST + 4, range, excess);
#endif
#if N_LEVELS > 5
    level_out[5] = scattered(FIRST + 5, range, excess);
#endif
#if N_LEVELS > 6
    level_out[6] = scattered(FIRST + 6, range, excess);
#endif
#ifndef WIDE
    level_out[N_LEVELS] = vec4(excess, count > 0.0 ? range : FAR);
#endif
}
`;var vc=`// Provides: one triangle over the whole target, without depth.
// Needs: nothing; three vertices without attributes.
// For the passes of physical water that work on whole images.
void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    gl_Position = vec4(corner, 0.0, 1.0);
}
`;var _c=`// Provides: depth only, which the rasteriser writes.
// Needs: nothing.
// For all shadow maps.
void main() {}
`;var yc=`// Provides: sun_share(map_point), 0 in the sun's shadow to 1 in full sunlight.
// Needs: the shadow map; map_point = texture coordinates and depth of a point in it, 0..1.
// One hardware comparison of 2 x 2 texels, or with the switch SOFT the mean of four; points outside the map are lit.
uniform sampler2DShadow shadow_map;

float sun_share(vec3 map_point) {
    vec3 inside = step(abs(map_point - 0.5), vec3(0.5));
#ifdef SOFT
    if (inside.x * inside.y * inside.z == 0.0) return 1.0;
    vec2 texel = 1.25 / vec2(textureSize(shadow_map, 0));
    float sum = 0.0;
    for (int i = -1; i <= 1; i += 2)
        for (int j = -1; j <= 1; j += 2) sum += textureLod(shadow_map, map_point + vec3(vec2(i, j) * texel, 0.0), 0.0);
    return sum / 4.0;
#else
    return inside.x * inside.y * inside.z > 0.0 ? texture(shadow_map, map_point) : 1.0;
#endif
}
`;var bc=`// Provides: the vertices of a shadow caster in the view of a light.
// Needs: instance.glsl, filled with matrices to the light's clip space instead of the camera frame.
// Used for the shadow maps of the sun, the lamps and the projector.
#include "instance.glsl"

in vec3 vertex;

void main() {
    gl_Position = camera_from_model * vec4(vertex, 1.0);
}
`;var wc=`// Provides: sunlit(colour, facing, mirrored, lit), the sunlight and ambient light that a surface reflects.
// Needs: varyings.glsl; facing = N.L; mirrored = R.E; lit = share of the sunlight that arrives, 0..1. N: normal,
// L: direction to the sun, R: direction of the mirrored sunlight, E: direction to the camera.
// With the switch POLISHED: surfaces are glossy, 0.3 max(R.E, 0)^32, and in the shade ambient light has the
// water's hue.
// Else UWSim's image model: q (Ia C + Id C max(N.L, 0) + Is max(R.E, 0)^2 where N.L > 0), with light rate q, surface
// colour C, and the ambient, diffuse and specular light Ia, Id, Is.
vec3 sunlit(vec3 colour, float facing, float mirrored, float lit) {
    float reached = facing > 0.0 ? lit : 0.0;
    float glint = max(mirrored, 0.0);
#ifdef POLISHED
    vec3 hue = v_water_colour.rgb / max(max(v_water_colour.r, v_water_colour.g), max(v_water_colour.b, 1e-3));
    vec3 ambient = v_lights.w * mix(0.8 + 0.35 * hue, vec3(1.0), reached);
    float narrow = glint * glint * glint * glint;
    narrow *= narrow;
    narrow *= narrow;
    narrow *= narrow;
    vec3 film = v_lights.rgb * (0.3 * narrow * reached);
    return colour * (ambient + v_lights.rgb * (facing * reached)) + film;
#endif
    return colour * (v_lights.w + v_lights.rgb * (facing * reached)) + v_water_colour.w * glint * glint * reached;
}
`;var xc=`// Provides: colour, range and id of a surface seen through water, whichever are requested.
// Needs: varyings.glsl, instance.glsl, sun.glsl, water.glsl, grey.glsl, shadow.glsl, lamplight.glsl, projection.glsl, targets.glsl, material.glsl.
// The switch ALPHA_TEST is the alpha of holes, 1..255 of 255. EMISSION and EMISSION_MAP add emitted light, under PHYSICAL only.
// The switch OPACITY is 1..254 of 255; without it the surface is opaque. The renderer blends.
// Light, then attenuation, then fog, on stored values; noise and conversion to 8 bit follow in noise.py.
#define VARYING in
#include "varyings.glsl"
#include "targets.glsl"
#ifdef IDS
#include "instance.glsl"
#endif
#ifdef COLOUR
#ifdef PHYSICAL
#include "optics.glsl"
#include "daylight.glsl"
#ifdef SKY
#include "surface_block.glsl"
#include "skylight.glsl"
#endif
#else
#include "sun.glsl"
#include "water.glsl"
#endif
#include "grey.glsl"
#if defined(NORMAL_MAP) || defined(MICROFACET)
#include "material.glsl"
#endif
#ifdef EMISSION_MAP
uniform sampler2D emission_map;
#endif
#ifdef SHADOWS
#include "shadow.glsl"
#endif
#ifdef LAMPS
#include "lamps.glsl"
#include "lamplight.glsl"
#endif
#ifdef PROJECTOR
#include "projector.glsl"
#include "projection.glsl"
#endif
#endif
#if defined(TEXTURED) && (defined(COLOUR) || defined(ALPHA_TEST))
uniform sampler2D base_map;
#endif

void main() {
#ifdef ALPHA_TEST
    vec4 base = texture(base_map, v_uv);
    if (base.a < float(ALPHA_TEST) / 255.0) discard;
#endif
#if defined(COLOUR) || defined(RANGE)
    float range = length(v_position);
#endif
#ifdef COLOUR
    vec3 colour = v_base_colour;
#ifdef ALPHA_TEST
    colour *= base.rgb;
#elif defined(TEXTURED)
    colour *= texture(base_map, v_uv).rgb;
#endif
    float unit = inversesqrt(max(dot(v_normal, v_normal), 1e-12));
    unit = gl_FrontFacing ? unit : -unit;
#ifdef NORMAL_MAP
    vec3 normal = mapped_normal(v_normal * unit);
    float facing = dot(normal, v_sun);
#else
    vec3 normal = v_normal * unit;
    float facing = v_terms.x * unit;
#endif
#ifdef PHYSICAL
    colour = albedo_of(colour);
#ifdef NORMAL_MAP
    float upward = dot(normal, v_up);
#else
    float upward = v_terms.w * unit;
#endif
#elif defined(NORMAL_MAP)
    float mirrored = (v_terms.y - 2.0 * facing * dot(normal, v_position)) / range;
#else
    float mirrored = (v_terms.y - 2.0 * facing * unit * dot(v_normal, v_position)) / range;
#endif
    float lit = 1.0;
#ifdef SHADOWS
    lit = sun_share(v_shadow_uv);
#endif
#ifdef FOG_CLIP
    float fog_range = v_terms.w;
#else
    float fog_range = range;
#endif
#ifdef MICROFACET
    prepare_material(colour, normal, v_terms.z);
    vec3 dry = material_daylight(normal, facing, upward, lit, v_terms.z);
#elif defined(PHYSICAL)
    vec3 dry = colour * daylight(facing, upward, lit, v_terms.z);
#else
    vec3 dry = sunlit(colour, facing, mirrored, lit);
#endif
#ifdef SKY
    if (v_terms.z < 0.0) dry = colour * skylight(normal, lit);
#endif
#ifdef LAMPS
    dry += lamplight(colour, normal);
#endif
#ifdef PROJECTOR
    dry = projected(dry, colour, normal);
#endif
#ifdef EMISSION
    vec3 emitted = v_emission;
#ifdef EMISSION_MAP
    emitted *= albedo_of(texture(emission_map, v_uv).rgb);
#endif
    dry += emitted;
#endif
#ifdef AIR
    float deeper = max(v_terms.z, v_camera_depth);
    float wet = clamp(deeper / max(deeper - min(v_terms.z, v_camera_depth), 1e-6), 0.0, 1.0);
    fog_range *= wet;
    float water_range = range * wet;
#else
    float water_range = range;
#endif
#ifdef OPACITY
    float opacity = float(OPACITY) / 255.0;
#else
    float opacity = 1.0;
#endif
#ifdef PHYSICAL
#ifdef OPACITY
    colour_out = vec4(dry, opacity);
#else
    colour_out = vec4(dry, water_range);  // the water follows in whole images: physical/development.py
#endif
#else
    colour_out = vec4(camera_colour(through_water(dry, water_range, fog_range, v_terms.z)), opacity);
#endif
#endif
#ifdef RANGE
    range_out = range;
#endif
#ifdef IDS
    id_out = identity.x;
#endif
}
`;var Ec=`// Provides: the vertices of a model, in the camera frame and on the image.
// Needs: frame.glsl, instance.glsl, varyings.glsl, lamps.glsl, projector.glsl.
// Terms that are linear in space are computed here; their interpolation is exact.
#define VARYING out
#include "frame.glsl"
#include "instance.glsl"
#include "varyings.glsl"
#if defined(COLOUR) && defined(PHYSICAL)
#include "optics.glsl"
#ifdef CAUSTICS
#include "caustics_block.glsl"
#endif
#endif
#if defined(COLOUR) && defined(LAMPS)
#include "lamps.glsl"
#endif
#if defined(COLOUR) && defined(PROJECTOR)
#include "projector.glsl"
#endif

in vec3 vertex;
#ifdef COLOUR
in vec3 vertex_normal;
in vec3 tint;
#ifdef NORMAL_MAP
in vec4 tangent;
#endif
#if defined(NORMAL_MAP) || defined(MICROFACET)
in vec3 finish;
#endif
#ifdef EMISSION
in vec3 emission;
#endif
#endif
#if defined(HAS_UV) && (defined(COLOUR) || defined(ALPHA_TEST))
in vec2 uv;
#endif

void main() {
    vec4 point = camera_from_model * vec4(vertex, 1.0);
    v_position = point.xyz;
    gl_Position = clip_from_camera * point;
#if defined(HAS_UV) && (defined(COLOUR) || defined(ALPHA_TEST))
    v_uv = uv;
#endif
#ifdef COLOUR
    v_normal = mat3(camera_normals) * vertex_normal;
    v_terms.x = dot(v_normal, sun.xyz);
    v_terms.y = dot(v_position, sun.xyz);
    v_terms.z = -(dot(v_position, up.xyz) + up.w);
#ifdef PHYSICAL
    v_terms.w = dot(v_normal, up.xyz);
#else
    v_terms.w = clip_fog.y - clip_fog.x * v_position.z;
#endif
    v_base_colour = tint;
    v_attenuation = attenuation.rgb;
#ifdef PHYSICAL
    v_sun_beam = vec4(sun_beam.rgb, upwelling.w);
    v_sun_loss = sun_loss.rgb;
    v_daylight_total = daylight_total.rgb;
    v_daylight_loss = daylight_loss.rgb;
    v_upwelling = upwelling.rgb;
#ifdef CAUSTICS
    v_caustic_place = vec2(dot(v_position, caustic_x.xyz), dot(v_position, caustic_y.xyz)) + vec2(caustic_x.w, caustic_y.w);
    v_caustic_depths = caustic_depths;
    v_swell_frame = swell_frame;
    v_caustic_loss = caustic_loss.rgb;
#endif
#else
    v_lights = vec4(sunlight.rgb, ambient_specular.x);
    v_water_colour = vec4(water_colour.rgb, ambient_specular.y);
    v_fog = fog;
#endif
#ifdef NORMAL_MAP
    mat3 rotation = mat3(camera_from_model);
    vec3 along = rotation * tangent.xyz;
    v_tangent = vec4(along * inversesqrt(max(dot(along, along), 1e-12)), tangent.w * sign(determinant(rotation)));
#endif
#if defined(NORMAL_MAP) || defined(MICROFACET)
    v_sun = sun.xyz;
    v_up = up.xyz;
    v_finish = finish;
#endif
#ifdef EMISSION
    v_emission = emission;
#endif
#ifdef AIR
    v_camera_depth = -up.w;
#endif
#ifdef SHADOWS
#ifdef SOFT
    float lift = 2.5 * sun.w;  // look-ups are wider
#else
    float lift = sun.w;
#endif
    vec3 lifted = v_position + v_normal * (lift * inversesqrt(max(dot(v_normal, v_normal), 1e-12)));
    v_shadow_uv = (shadow_from_camera * vec4(lifted, 1.0)).xyz;
#endif
#ifdef LAMPS
    vec3 unit_normal = v_normal * inversesqrt(max(dot(v_normal, v_normal), 1e-12));
    for (int i = 0; i < LAMPS; ++i) {
        vec3 towards = lamp_position[i].xyz - v_position;
        float lift = lamp_light[i].w * dot(towards, lamp_axis[i].xyz) * sign(dot(unit_normal, towards));
        v_lamp_uv[i] = lamp_from_camera[i] * vec4(v_position + unit_normal * lift, 1.0);
    }
#endif
#ifdef PROJECTOR
    vec3 outwards = v_normal * inversesqrt(max(dot(v_normal, v_normal), 1e-12));
    vec3 back = projector_position.xyz - v_position;
    float raise = projector_axis.w * dot(back, projector_axis.xyz) * sign(dot(outwards, back));
    v_projector_uv = projector_from_camera * vec4(v_position + outwards * raise, 1.0);
#endif
#endif
}
`;var Sc=`// Provides: the requested outputs; the switches COLOUR, RANGE and IDS are their locations, or undefined.
// Needs: nothing.
// Colour: stored values 0..1. Range: along the ray [m], inf: no surface. Id 0: no surface.
#ifdef COLOUR
layout(location = COLOUR) out vec4 colour_out;
#endif
#ifdef RANGE
layout(location = RANGE) out float range_out;
#endif
#ifdef IDS
layout(location = IDS) out uint id_out;
#endif
`;var Ac=`// Provides: direct(range) and whole_field(range), shares of light that arrives; weight(row, range), a share of scattered light.
// Needs: optics.glsl; the table of physical/blur_weights.py: row 0 is sharp light, row 1 + level that of a level of blur.
// Direct light is neither absorbed nor scattered; the whole field is that of a wide target. Formulas: optics/transmission.py.
uniform sampler2D weight_table;

vec3 direct(float range) {
    return exp((absorption.rgb + scattering.rgb) * -range);
}

vec3 whole_field(float range) {
    vec3 absorbed = absorption.rgb * range;
    vec3 wide_loss = scattering.w * sqrt(absorbed) + vec3(absorption.w);
    return exp(-absorbed - scattering.rgb * range * wide_loss);
}

vec3 weight(int row, float range) {
    vec2 size = vec2(textureSize(weight_table, 0));
    float share = range / (range + camera.z);
    return textureLod(weight_table, vec2((share * (size.x - 1.0) + 0.5) / size.x, (float(row) + 0.5) / size.y), 0.0).rgb;
}
`;var Mc=`// Provides: the varyings of a surface; VARYING is \`out\` in the vertex shader, \`in\` in the fragment shader.
// Needs: the switches COLOUR, TEXTURED, SHADOWS, AIR, PROJECTOR, and LAMPS, the number of lamps; those of material.glsl.
// Flat varyings pass on constants of the block Frame: llvmpipe reads them much faster than uniforms in each pixel.
#if defined(TEXTURED) || defined(NORMAL_MAP) || defined(FINISH_MAP) || defined(EMISSION_MAP)
#define HAS_UV
#endif
VARYING vec3 v_position;  // camera frame [m]
#if defined(HAS_UV) && (defined(COLOUR) || defined(ALPHA_TEST))
VARYING vec2 v_uv;  // texture coordinates
#endif
#ifdef COLOUR
VARYING vec3 v_normal;  // camera frame, any length
VARYING vec4 v_terms;  // x: N.L |N|; y: P.L [m] (L: to the sun, P: position); z: depth below the water's surface [m]; w: clip-space z [m], PHYSICAL: N.up |N|
flat VARYING vec3 v_base_colour;  // colour of the mesh
flat VARYING vec3 v_attenuation;  // attenuation of rgb [1/m]
#ifdef PHYSICAL
flat VARYING vec4 v_sun_beam;  // these are sun_beam, sun_loss ... of optics.glsl; w: upwelling.w
flat VARYING vec3 v_sun_loss;
flat VARYING vec3 v_daylight_total;
flat VARYING vec3 v_daylight_loss;
flat VARYING vec3 v_upwelling;
#ifdef CAUSTICS
VARYING vec2 v_caustic_place;  // where the sun's beam to the point enters the water [tiles]
flat VARYING vec4 v_caustic_depths;  // these are of caustics_block.glsl
flat VARYING vec4 v_swell_frame;
flat VARYING vec3 v_caustic_loss;
#endif
#else
flat VARYING vec4 v_lights;  // rgb: sunlight; w: ambient
flat VARYING vec4 v_water_colour;  // rgb: water colour; w: specular
flat VARYING vec4 v_fog;  // rgb: fog colour; w: density squared [1/m2]
#endif
#ifdef NORMAL_MAP
VARYING vec4 v_tangent;  // xyz: camera frame; w: 1, or -1 where the texture is mirrored
#endif
#if defined(NORMAL_MAP) || defined(MICROFACET)
flat VARYING vec3 v_sun;  // towards the sun, camera frame
flat VARYING vec3 v_up;  // W's z axis, camera frame
flat VARYING vec3 v_finish;  // x: roughness; y: share of metal; z: scale of the normal map
#endif
#ifdef EMISSION
flat VARYING vec3 v_emission;  // emitted radiance
#endif
#ifdef AIR
flat VARYING float v_camera_depth;  // depth of the camera below the water's surface [m]
#endif
#ifdef SHADOWS
VARYING vec3 v_shadow_uv;  // texture coordinates and depth in the shadow map, 0..1
#endif
#ifdef LAMPS
VARYING vec4[LAMPS] v_lamp_uv;  // homogeneous texture coordinates and depth in the lamps' shadow maps
#endif
#ifdef PROJECTOR
VARYING vec4 v_projector_uv;  // homogeneous texture coordinates and depth in the projector's shadow map
#endif
#endif
`;var Tc=`// Provides: through_water(lit, range, fog_range, depth), the colour of a surface at the camera.
// Needs: varyings.glsl; the switch NO_FOG if the fog density is 0; range: along the ray in water, fog_range: distance in
// the fog, depth: below the water's surface [m].
// lit E + w (1 - E exp(-0.001 depth)) with E = exp(-2 a range), then fog with exp(-(f fog_range)^2): see water.py.
vec3 through_water(vec3 lit, float range, float fog_range, float depth) {
    vec3 transmission = exp(v_attenuation * (-2.0 * range));
    float dimmed = exp(-0.001 * max(depth, 0.0));
    vec3 colour = transmission * (lit - v_water_colour.rgb * dimmed) + v_water_colour.rgb;
#ifdef NO_FOG
    return colour;
#else
    return mix(v_fog.rgb, colour, exp(-v_fog.w * fog_range * fog_range));
#endif
}
`;var Rc=`// Provides: coverage D (J - B) of a particle, and its coverage as alpha; the renderer draws it over those behind.
// Needs: optics.glsl, open_water.glsl; the outputs of particle.vert.glsl; the image of the surfaces.
// J: radiance of the particle, B: of open water behind it, D = exp(-c r). Nearer surfaces hide it.
#include "optics.glsl"
#include "open_water.glsl"
uniform sampler2D surface_image;
flat in vec4 v_light;
flat in vec4 v_shape;
noperspective in vec2 v_offset;
out vec4 colour_out;

void main() {
    vec2 inner = v_offset / v_shape.xy;
    float square = dot(inner, inner);
    float inside = 1.0 - square;
    if (inside <= 0.0) discard;
    float range = texelFetch(surface_image, ivec2(gl_FragCoord.xy), 0).a;
    if (range < v_light.a) discard;
    float profile = 3.0 * inside * inside;
    // the rim of a bubble is seen if its image is large enough
    if (v_shape.w > 0.5) profile = mix(profile, 30.0 * square * square * inside * inside, clamp(0.5 * v_shape.y - 1.0, 0.0, 0.85));
    float coverage = min(v_shape.z * profile, 1.0);
    vec3 water = open_water(gl_FragCoord.xy, vec2(textureSize(surface_image, 0)));
    vec3 direct = exp((absorption.rgb + scattering.rgb) * -v_light.a);
    colour_out = vec4(coverage * direct * (v_light.rgb - water), coverage);
}
`;var Lc=`// Provides: the rectangle around the image of a particle, and the particle's radiance.
// Needs: frame.glsl, optics.glsl, particle_lens.glsl; lamps.glsl with LAMPS; four vertices for each instance, a record of PARTICLE.
// The radiance is rho (E_sun + 2 E_down + 2 E_up + sum of E_lamp): physical/particle_pass.py.
#include "frame.glsl"
#include "optics.glsl"
#include "particle_lens.glsl"
#ifdef LAMPS
#include "lamps.glsl"
uniform sampler2DShadow lamp_maps;
#endif
uniform sampler2D surface_image;
in vec4 place;   // xyz: camera frame [m]; w: radius [m]
in vec4 extent;  // xyz: motion during the exposure and own length, camera frame [m]; w: share that is drawn
in vec2 traits;  // x: reflectance; y: kind
flat out vec4 v_light;   // rgb: radiance; a: range [m]
flat out vec4 v_shape;   // x, y: half the length and the width [px]; z: coverage; w: kind
noperspective out vec2 v_offset;  // along and across the streak [px]

vec2 pixel_of(vec3 point) {
    vec2 slope = point.xy / max(-point.z, 0.01) - ray_first.xy;
    float row = slope.y / ray_row.y;
    return vec2((slope.x - row * ray_row.x) / ray_column.x, row);
}

vec3 lit(vec3 point) {
    float z = max(-(dot(point, up.xyz) + up.w), 0.0);
    vec3 total = daylight_total.rgb * exp(daylight_loss.rgb * -z);
    vec3 level = min(sun_beam.rgb * exp(sun_loss.rgb * -z), total);
    vec3 sum = level / upwelling.w + 2.0 * (total - level) + 2.0 * upwelling.rgb * total;
#ifdef LAMPS
    for (int i = 0; i < LAMPS; ++i) {
        vec3 towards = lamp_position[i].xyz - point;
        float distance = max(length(towards), 0.03);
        float cosine = dot(lamp_axis[i].xyz, towards) / distance;
        float cone = clamp((cosine - lamp_position[i].w) * lamp_axis[i].w, 0.0, 1.0);
        float share = 1.0;
        if (lamp_position[i].w > -1.0) {
            vec4 uv = lamp_from_camera[i] * vec4(point, 1.0);
            share = cone > 0.0 ? textureLod(lamp_maps, uv.xyz / uv.w, 0.0) : 0.0;
        } else {
            cone = 1.0;
        }
        vec3 energy = lamp_optics[i].x - lamp_optics[i].y * sqrt(absorption.rgb * (2.0 * distance));
        vec3 transmission = exp((absorption.rgb + scattering.rgb * (1.0 - energy)) * -distance);
        sum += lamp_light[i].rgb * transmission * (cone * cone * (3.0 - 2.0 * cone) * share / (distance * distance));
    }
#endif
    return sum;
}

void main() {
    vec2 size = vec2(textureSize(surface_image, 0));
    float range = length(place.xyz);
    float depth = max(-place.z, 0.01);
    vec2 first = pixel_of(place.xyz - 0.5 * extent.xyz);
    vec2 last = pixel_of(place.xyz + 0.5 * extent.xyz);
    vec2 streak = last - first;
    float streak_length = min(length(streak), 0.5 * size.x);
    vec2 along = streak_length > 0.01 ? normalize(streak) : vec2(1.0, 0.0);
    float focal = inversesqrt(abs(ray_column.x * ray_row.y));
    float radius = place.w * focal / depth;
    float blur = particle_lens.x * focal * abs(1.0 / depth - particle_lens.y);
    float drawn = max(1.7320508 * sqrt(radius * radius + blur * blur), particle_lens.z);
    float coverage = extent.w * radius * radius / (drawn * (drawn + 0.5 * streak_length));
    vec2 corner = vec2(gl_VertexID % 2 == 0 ? -1.0 : 1.0, gl_VertexID < 2 ? -1.0 : 1.0);
    v_offset = corner * vec2(0.5 * streak_length + drawn, drawn);
    v_light = vec4(traits.x * lit(place.xyz), range);
    v_shape = vec4(0.5 * streak_length + drawn, drawn, coverage, traits.y);
    vec2 pixel = 0.5 * (first + last) + v_offset.x * along + v_offset.y * vec2(-along.y, along.x);
    gl_Position = vec4(2.0 * pixel / size - 1.0, 0.0, 1.0);
}
`;var Pc=`// Provides: the block ParticleLens, the lens through which particles are seen.
// Needs: nothing. Filled by physical/particle_pass.py, where the same members are declared.
// A lens with the aperture A, focused at the distance F, blurs a point at r by A |1/r - 1/F|.
layout(std140) uniform ParticleLens {
    vec4 particle_lens;  // x: radius of the aperture [m]; y: 1 / distance of the focus [1/m]; z: least radius of an image [px]
};
`;var Ic=`// Provides: the image of surfaces, radiance and range in water, without the water's surface: bodies, and the sky above it.
// Needs: optics.glsl, surface_block.glsl, waves.glsl, sky.glsl; the image of the surfaces, whose alpha is the whole range.
// Pixels that begin in air have the range 0 in water; the sea follows in water_surface.frag.glsl.
#include "optics.glsl"
#include "surface_block.glsl"
#include "waves.glsl"
#include "sky.glsl"
uniform sampler2D surface_image;
out vec4 light_out;

void main() {
    vec4 texel = texelFetch(surface_image, ivec2(gl_FragCoord.xy), 0);
    vec3 ray = mat3(world_from_ray) * (ray_first.xyz + gl_FragCoord.x * ray_column.xyz + gl_FragCoord.y * ray_row.xyz);
    float height = eye.x + eye.y * ray.z;
#ifdef WAVES
    float variance;
    if (abs(height) < bounds.x) height -= waves_at(eye.y * ray.xy, 0.0, variance).x;
#endif
    light_out = texel;
    if (height <= 0.0) return;
    vec3 direction = normalize(ray);
    vec3 light = texel.a < 0.5 * FAR ? through_air(texel.rgb, direction, texel.a) : sky_in(direction) + sun_in(direction, 0.0);
    light_out = vec4(light, 0.0);
}
`;var kc=`// Provides: reflectance(cosine, sine_ratio), the share of unpolarised light that the surface reflects.
// Needs: nothing; cosine of incidence; sine_ratio = sine of refraction over sine of incidence: 1 / n from air, n from water.
// 1 where the light is totally reflected.
float reflectance(float cosine, float sine_ratio) {
    float squared = 1.0 - sine_ratio * sine_ratio * (1.0 - cosine * cosine);
    if (squared <= 0.0) return 1.0;
    float refracted = sqrt(squared);
    float s = (sine_ratio * cosine - refracted) / (sine_ratio * cosine + refracted);
    float p = (cosine - sine_ratio * refracted) / (cosine + sine_ratio * refracted);
    return 0.5 * (s * s + p * p);
}
`;var Fc=`// Provides: sky_in(direction), the sky without the sun; sun_in(direction, variance); water_in(direction); through_air(light, direction, range).
// Needs: surface_block.glsl; the hemispheres of surface/hemispheres.py. Directions are unit vectors in W.
// sun_in: the sun's image with a blur of that variance along each axis [rad2]; water_in: the open water below the surface.
uniform sampler2DArray hemispheres;

vec3 hemisphere(vec3 direction, float layer) {
    vec2 place = direction.xy / (1.0 + max(direction.z, 0.0));
    float size = float(textureSize(hemispheres, 0).x);
    return textureLod(hemispheres, vec3((place * (size - 1.0) / size) * 0.5 + 0.5, layer), 0.0).rgb;
}

vec3 sky_in(vec3 direction) {
    return hemisphere(direction.z < 0.0 ? vec3(direction.xy * inversesqrt(max(dot(direction.xy, direction.xy), 1e-12)), 0.0) : direction, 0.0);
}

vec3 water_in(vec3 direction) {
    return hemisphere(vec3(direction.xy, -direction.z), 1.0);
}

vec3 sun_in(vec3 direction, float variance) {
    float total = variance + 0.25 * sky_sun.w * sky_sun.w + 0.25 * air.z * air.z;
    vec3 apart = direction - sky_sun.xyz;
    return sky_sun_light.rgb * (0.5 / total * exp(-0.5 * dot(apart, apart) / total));
}

vec3 through_air(vec3 light, vec3 direction, float range) {
    return mix(sky_in(vec3(direction.xy, -1.0)), light, exp(-air.x * range));
}
`;var Cc=`// Provides: skylight(normal, share), the light of sun and sky on a surface in air, and of the sea below it.
// Needs: surface_block.glsl; the unit normal in the camera frame; share = 0 in the sun's shadow to 1.
// The sky and the sea count as even; the sea reflects 6 % of the light.
vec3 skylight(vec3 normal, float share) {
    vec3 upright = mat3(world_from_ray) * normal;
    vec3 level = sky_light.rgb + sky_sun_light.rgb * sky_sun.z;
    return sky_sun_light.rgb * (max(dot(upright, sky_sun.xyz), 0.0) * share)
        + sky_light.rgb * (0.5 + 0.5 * upright.z) + level * (0.03 - 0.03 * upright.z);
}
`;var Oc=`// Provides: the block Surface, the numbers of the water's surface, the sky and the air.
// Needs: nothing. Filled by surface/surface_block.py, where the same members are declared.
// Offsets are positions in W minus that of the camera [m].
layout(std140) uniform Surface {
    mat4 clip_from_offset;
    mat4 world_from_ray;   // rotation: W from the camera frame (OpenGL axes)
    vec4 eye;              // x: height of the camera above the still surface [m]; y: near plane [m]; w: number of grids
    vec4[4] grids;         // for each grid: xy: texture coordinates of the camera; z: 1 / edge [1/m]; w: spacing [m]
    vec4 roughness;        // variance of the slopes that each grid leaves out
    vec4 ripples;          // x: factor on the slopes of a tile; y: their variance; z: 1 / edge of the tile [1/m]; w: its spacing [m]
    vec4 ripple_origin;    // xy: camera in the tile [m]
    vec4 ripple_turn;      // xy: camera in the turned, smaller tile [m]; zw: cosine and sine of its turn over its size
    vec4 bounds;           // x: greatest elevation of waves [m]; y: variance of their slopes along one axis
    vec4 sky_sun;          // xyz: towards the sun above the water, W; w: its angular radius [rad]
    vec4 sky_sun_light;    // rgb: irradiance of a surface that faces the sun; w: cosine of the refracted sun from the zenith
    vec4 sky_light;        // rgb: irradiance of a level surface by the sky
    vec4 water_light;      // rgb: radiance of the open water from below the surface, even
    vec4 image_size;       // xy: width and height [px]
    vec4 air;              // x: attenuation of air [1/m]; y: refractive index of water; z: angle of a pixel [rad]
};
`;var Nc=`// Provides: numbers of the block Surface as flat varyings; VARYING is \`out\` in the vertex shader, \`in\` in the fragment shader.
// Needs: surface_block.glsl; the switches WAVES, RIPPLES and FOAM. In the fragment shader, include it before waves.glsl and sky.glsl:
// their names of members of the block then are these varyings. llvmpipe reads them much faster than uniforms in each pixel.
flat VARYING vec4 v_air;
flat VARYING vec4 v_sky_sun;
flat VARYING vec4 v_sky_sun_light;
flat VARYING vec4 v_water_light;
#if defined(WAVES) && WAVES == 1
flat VARYING vec4[1] v_grids;
flat VARYING vec4 v_roughness;
#endif
#ifdef RIPPLES
flat VARYING vec4 v_ripples;
flat VARYING vec4 v_ripple_origin;
flat VARYING vec4 v_ripple_turn;
#endif
#ifdef FOAM
flat VARYING vec4 v_sky_light;
#endif
#ifdef READS_VARYINGS
#define air v_air
#define sky_sun v_sky_sun
#define sky_sun_light v_sky_sun_light
#define water_light v_water_light
#if defined(WAVES) && WAVES == 1
#define grids v_grids
#define roughness v_roughness
#endif
#define ripples v_ripples
#define ripple_origin v_ripple_origin
#define ripple_turn v_ripple_turn
#define sky_light v_sky_light
#else
void pass_on_surface() {
    v_air = air;
    v_sky_sun = sky_sun;
    v_sky_sun_light = sky_sun_light;
    v_water_light = water_light;
#if defined(WAVES) && WAVES == 1
    v_grids[0] = grids[0];
    v_roughness = roughness;
#endif
#ifdef RIPPLES
    v_ripples = ripples;
    v_ripple_origin = ripple_origin;
    v_ripple_turn = ripple_turn;
#endif
#ifdef FOAM
    v_sky_light = sky_light;
#endif
}
#endif
`;var Dc=`// Provides: the radiance and the range in water of the water's surface, from below, or with the switch ABOVE from above.
// Needs: optics.glsl, surface_block.glsl, surface_varyings.glsl, waves.glsl, sky.glsl, fresnel.glsl; transmission.glsl from above;
// without the switch DIRECT, the image of the surfaces, whose alpha is the whole range; the switch BODIES_ABOVE if one may be mirrored.
// From below: sky refracted, open water reflected; the water before it follows in whole images (physical/development.py), which
// takes the open water B behind it away. From above: sky reflected, the water and the bodies in it refracted. See surface_pass.py.
#include "optics.glsl"
#include "surface_block.glsl"
#define VARYING in
#define READS_VARYINGS
#include "surface_varyings.glsl"
#include "waves.glsl"
#include "sky.glsl"
#include "fresnel.glsl"
#ifdef ABOVE
#include "transmission.glsl"
#endif
#ifndef DIRECT
uniform sampler2D surface_image;
#endif
in vec3 v_offset;
#ifndef ABOVE
in vec3 v_open_water;
#endif
out vec4 light_out;
const float PI = 3.14159265;
#ifdef FOAM
const float FOAM_START = 0.35;  // downward acceleration over gravity: surface/surface_pass.py
const float FOAM_END = 0.5;
#endif

#ifdef ABOVE
// Follow a ray from a point of the surface within the picture to a body above (side 1) or below (side -1) the still surface: six
// distances, each 2.2 times the one before, then two halvings. Return the way to the body, or 0; seen is its pixel. Below, the border of the picture is continued.
float follow(vec3 direction, float side, float range, ivec2 size, out vec4 seen) {
    vec4 here = clip_from_offset * vec4(v_offset, 1.0);
    vec4 change = clip_from_offset * vec4(direction, 0.0);
    float first = 0.0;
    float way = 0.25 / max(abs(direction.z), 0.1);
    float met = 0.0;
    ivec2 pixel = ivec2(0);
    for (int i = 0; i < 8; ++i) {
        vec4 clip = here + way * change;
        vec2 place = clip.xy / clip.w * 0.5 + 0.5;
        if (side > 0.0 && (clip.w <= 0.0 || place != clamp(place, 0.0, 1.0))) break;  // it does not come back
        ivec2 there = ivec2(clamp(place, 0.0, 0.9999) * vec2(size));
        float body_range = texelFetch(surface_image, there, 0).a;
        vec3 offset = v_offset + way * direction;
        float distance = length(offset);
        bool is_seen = clip.w > 0.0 && body_range > range * (0.5 - 0.5 * side)
            && body_range < distance && body_range > distance - max(way, 1.0) && side * (eye.x + offset.z * body_range / distance) > 0.0;
        if (is_seen) {
            met = way;
            pixel = there;
        }
        if (met > 0.0) {
            if (!is_seen) first = way;
            way = 0.5 * (first + met);
            if (i >= 7) break;
        } else {
            first = way;
            if (i >= 5) break;
            way *= 2.2;
        }
    }
    seen = met > 0.0 ? texelFetch(surface_image, pixel, 0) : vec4(0.0);
    return met;
}

vec3 light_above(vec3 towards, float range, vec3 normal, float variance, ivec2 size) {
    float cosine = max(-dot(towards, normal), 0.0);
    float share = reflectance(sqrt(min(cosine * cosine + 0.5 * variance, 1.0)), 1.0 / air.y);
    vec3 mirrored = reflect(towards, normal);
    mirrored = normalize(vec3(mirrored.xy, abs(mirrored.z) + 0.5 * sqrt(variance)));
    vec4 seen;
    vec3 above = sky_in(mirrored);
#ifdef BODIES_ABOVE
    if (follow(mirrored, 1.0, range, size, seen) > 0.0) above = seen.rgb;
#endif
    vec3 light = share * above;
    vec3 half_way = normalize(sky_sun.xyz - towards);
    float steep = max(half_way.z, 0.05);
    float spread = variance + 0.0625 * sky_sun.w * sky_sun.w + 0.0625 * air.z * air.z;
    vec2 apart = half_way.xy / -steep - normal.xy / -normal.z;
    float facets = exp(-0.5 * dot(apart, apart) / spread) / (2.0 * PI * spread);
    float glint = reflectance(max(-dot(half_way, towards), 0.0), 1.0 / air.y) * PI * facets;
    light += sky_sun_light.rgb * (glint / (4.0 * max(cosine, 0.05) * steep * steep * steep * steep));
    vec3 refracted = refract(towards, normal, 1.0 / air.y);
    vec3 below = water_in(refracted);
    float met = follow(refracted, -1.0, range, size, seen);
    if (met > 0.0) below = mix(below, seen.rgb, whole_field(met));
    return light + (1.0 - share) / (air.y * air.y) * below;
}

#else
// In the window the open water that is reflected counts as even, so one look-up is enough.
vec3 light_below(vec3 towards, vec3 normal, float variance) {
    float cosine = clamp(dot(towards, normal), 1e-3, 1.0);
    float share = reflectance(cosine, air.y);
    vec3 refracted = refract(towards, -normal, air.y);
    vec3 mirrored = reflect(towards, normal);
    bool is_window = share < 1.0;
    vec3 direction = is_window ? vec3(refracted.xy, max(refracted.z, 0.0)) : vec3(mirrored.xy, abs(mirrored.z));
    vec3 light = hemisphere(direction, is_window ? 0.0 : 1.0);
    if (!is_window) return light;
    float slant = dot(refracted, normal);
    float turn = (air.y * cosine - slant) / max(slant, 0.15);
    light += sun_in(refracted, turn * turn * variance + 0.5 * air.z * air.z);
    return (1.0 - share) * air.y * air.y * light + share * water_light.rgb;
}
#endif

void main() {
    float range = length(v_offset);
#ifndef DIRECT
    vec4 texel = texelFetch(surface_image, ivec2(gl_FragCoord.xy), 0);
    if (texel.a < range) discard;
#endif
    vec3 towards = v_offset / range;
    float variance;
    float footprint = range * air.z / clamp(abs(towards.z), 0.02, 1.0);
    vec4 wave = waves_at(v_offset.xy, footprint, variance);
    vec2 slope = wave.yz;
#ifdef RIPPLES
    slope += add_ripples(v_offset.xy, footprint, variance);
#endif
    vec3 normal = normalize(vec3(-slope, 1.0));
#ifdef FOAM
    float streaks = 0.0;
#ifdef RIPPLES
    streaks = foam_pattern(v_offset.xy, footprint);
#endif
    float foam = 0.9 * smoothstep(FOAM_START, FOAM_END, wave.w + streaks);
    vec3 lit = sky_light.rgb + sky_sun_light.rgb * sky_sun.z;
#endif
#ifdef ABOVE
    vec3 light = light_above(towards, range, normal, variance, textureSize(surface_image, 0));
#ifdef FOAM
    light = mix(light, 0.5 * lit, foam);
#endif
    light_out = vec4(through_air(light, towards, range), 0.0);
#else
    vec3 light = light_below(towards, normal, variance);
#ifdef FOAM
    light = mix(light, 0.3 * lit, foam);
#endif
    light_out = vec4(light + v_open_water, range);
#endif
}
`;var Uc=`// Provides: the water's surface around the camera, raised by the waves.
// Needs: surface_block.glsl, surface_varyings.glsl, waves.glsl, open_water.glsl without the switch ABOVE; vertices are offsets from the camera in the horizontal plane of W [m].
// The far plane is at infinity; with the switch DIRECT it is that of the camera.
#include "surface_block.glsl"
#define VARYING out
#include "surface_varyings.glsl"
#include "waves.glsl"
#ifndef ABOVE
#include "open_water.glsl"
out vec3 v_open_water;  // behind the surface; even enough to be interpolated
#endif
in vec2 vertex;
out vec3 v_offset;

void main() {
    pass_on_surface();
    float variance;
    v_offset = vec3(vertex, waves_at(vertex, 0.0, variance).x - eye.x);
    gl_Position = clip_from_offset * vec4(v_offset, 1.0);
#ifndef ABOVE
    vec2 place = gl_Position.xy / max(gl_Position.w, 1e-3) * 0.5 + 0.5;
    v_open_water = open_water(clamp(place, 0.0, 1.0) * image_size.xy, image_size.xy);
#endif
#ifndef DIRECT
    gl_Position.z = gl_Position.w - 2.0 * eye.y;
#endif
}
`;var Vc=`// Provides: waves_at(offset, footprint, variance), the waves of the surface; add_ripples(...), the slopes of ripples.
// Needs: surface_block.glsl; the switches WAVES, the number of grids, and RIPPLES; the grids of surface/wave_grids.py and the tile of surface/ripples.py.
// offset: from the camera in the horizontal plane of W [m]; footprint: length of a pixel on the surface [m]; variance of the
// slopes along one axis that the pixel does not resolve. Finer grids go over into coarser ones without a seam.
#ifdef WAVES
#if WAVES == 1
uniform sampler2D wave_grid;

vec4 grid_at(int level, vec2 offset) {
    return textureLod(wave_grid, grids[0].xy + offset * grids[0].z, 0.0);
}
#else
uniform sampler2DArray wave_grids;

vec4 grid_at(int level, vec2 offset) {
    return textureLod(wave_grids, vec3(grids[level].xy + offset * grids[level].z, float(level)), 0.0);
}
#endif
#endif
#ifdef RIPPLES
uniform sampler2D ripple_tile;
#endif

// Elevation [m], slopes along x and y, downward acceleration over gravity.
vec4 waves_at(vec2 offset, float footprint, out float variance) {
    variance = 0.0;
    vec4 wave = vec4(0.0);
#if defined(WAVES) && WAVES == 1
    variance = roughness[0];
    wave = grid_at(0, offset);
#elif defined(WAVES)
    float distance = max(abs(offset.x), abs(offset.y)) * grids[0].z / 0.46;
    float coarse = 0.5 * log2(max(footprint / grids[0].w, 1e-6));
    float level = max(max(0.5 * log2(max(distance, 1e-6)) + 1.0, min(coarse, eye.w - 1.0)), 0.0);
    float share = smoothstep(0.5, 1.0, fract(level));
    int finer = int(level);
    int n = int(eye.w);
    variance = bounds.y;
    if (finer < n) {
        wave = grid_at(finer, offset);
        variance = roughness[finer];
    }
    if (share > 0.0) {
        wave *= 1.0 - share;
        variance *= 1.0 - share;
        if (finer + 1 < n) {
            wave += share * grid_at(finer + 1, offset);
            variance += share * roughness[finer + 1];
        } else {
            variance += share * bounds.y;
        }
    }
#endif
    return wave;
}

#ifdef RIPPLES
float tile_fade(float footprint, inout float variance) {
    float fade = 1.0 - smoothstep(3.0, 12.0, footprint / ripples.w);
    variance += ripples.y * (1.0 - fade * fade);
    return ripples.x * fade;
}

vec2 add_ripples(vec2 offset, float footprint, inout float variance) {
    mat2 turn = mat2(ripple_turn.z, ripple_turn.w, -ripple_turn.w, ripple_turn.z);
    float stretch = length(ripple_turn.zw);
    vec2 shift = vec2(0.5 / 128.0);
    vec2 slope = textureLod(ripple_tile, (ripple_origin.xy + offset) * ripples.z + shift, 0.0).yz;
    vec2 turned = textureLod(ripple_tile, (ripple_turn.xy + turn * offset) * ripples.z + shift, 0.0).yz;
    return tile_fade(footprint, variance) * slope + tile_fade(footprint * stretch, variance) / stretch * (transpose(turn) * turned);
}

// An irregular pattern of -0.1 to 0.1 for foam, by the tile and by one five times as large.
float foam_pattern(vec2 offset, float footprint) {
    vec2 place = (ripple_origin.xy + offset) * ripples.z;
    vec2 wide = textureLod(ripple_tile, place * 0.2, 0.0).yz;
    vec2 small = textureLod(ripple_tile, place, 0.0).yz;
    float fade = 1.0 - smoothstep(3.0, 12.0, footprint / ripples.w);
    return clamp(0.07 * (wide.x + wide.y * wide.x) + (0.06 * fade) * (small.x + small.y * small.x), -0.1, 0.1);
}
#endif
`;var zc=`// Provides: a finished image at its place on the page; an image twice as wide and high becomes the mean of its squares of four.
// Needs: presented.vert.glsl; the image, row 0 at the top, with linear interpolation.
in vec2 v_uv;
uniform sampler2D level_0;
out vec4 colour_out;

void main() {
    colour_out = textureLod(level_0, v_uv, 0.0);
}
`;var Gc=`// Provides: one triangle over the whole target, and the texture coordinates of its pixels.
// Needs: nothing; three vertices without attributes. With the switch FLIPPED, row 0 of the target is the lowest one of the image.
out vec2 v_uv;

void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    v_uv = 0.5 * corner + 0.5;
#ifdef FLIPPED
    v_uv.y = 1.0 - v_uv.y;
#endif
    gl_Position = vec4(corner, 0.0, 1.0);
}
`;var Bc=`// Provides: the waves at the points of a grid: elevation [m], slopes along x and y, downward acceleration over gravity.
// Needs: screen.vert.glsl; the factors of each component at the columns and at the rows of the grid (wave_grids.ts).
uniform sampler2D factors_x;  // cosine and sine of the phase; wave number along x [rad/m]; squared frequency over gravity [1/m]
uniform sampler2D factors_y;  // amplitude [m] times cosine and sine of the change of phase; wave number along y
out vec4 grid_out;

void main() {
    ivec2 point = ivec2(gl_FragCoord.xy);
    int n = textureSize(factors_x, 0).y;
    vec4 total = vec4(0.0);
    for (int i = 0; i < n; ++i) {
        vec4 x = texelFetch(factors_x, ivec2(point.x, i), 0);
        vec4 y = texelFetch(factors_y, ivec2(point.y, i), 0);
        float height = y.x * x.x - y.y * x.y;
        float steepness = y.x * x.y + y.y * x.x;
        total += vec4(height, -x.z * steepness, -y.z * steepness, x.w * height);
    }
    grid_out = total;
}
`;var Bm={"background.frag.glsl":ql,"background.vert.glsl":jl,"blurred.frag.glsl":$l,"blurred_rows.frag.glsl":Kl,"caustics.glsl":Ql,"caustics_block.glsl":Jl,"daylight.glsl":Zl,"developed.frag.glsl":ec,"frame.glsl":tc,"gaussian.glsl":rc,"grey.glsl":ic,"instance.glsl":sc,"lamp_point.frag.glsl":nc,"lamp_point.vert.glsl":ac,"lamp_veil.glsl":oc,"lamplight.glsl":lc,"lamps.glsl":cc,"material.glsl":fc,"open_water.glsl":uc,"optics.glsl":hc,"particle.frag.glsl":Rc,"particle.vert.glsl":Lc,"particle_lens.glsl":Pc,"presented.frag.glsl":zc,"presented.vert.glsl":Gc,"projection.glsl":dc,"projector.glsl":mc,"reduced.frag.glsl":pc,"scattered.frag.glsl":gc,"screen.vert.glsl":vc,"shadow.frag.glsl":_c,"shadow.glsl":yc,"shadow.vert.glsl":bc,"sun.glsl":wc,"surface.frag.glsl":xc,"surface.vert.glsl":Ec,"targets.glsl":Sc,"transmission.glsl":Ac,"varyings.glsl":Mc,"water.glsl":Tc,"air.frag.glsl":Ic,"fresnel.glsl":kc,"sky.glsl":Fc,"skylight.glsl":Cc,"surface_block.glsl":Oc,"surface_varyings.glsl":Nc,"water_surface.frag.glsl":Dc,"water_surface.vert.glsl":Uc,"waves.glsl":Vc,"wave_grid.frag.glsl":Bc},Hm=`#version 300 es
precision highp float;
precision highp int;
precision highp sampler2D;
precision highp sampler2DArray;
precision highp sampler2DShadow;
#define noperspective
`,Er={Frame:0,Instance:1,Lamps:2,Projector:3,Optics:4,Surface:7,ParticleLens:9},te={base_map:0,shadow_map:1,lamp_maps:2,projector_map:3,projector_pattern:4,open_water_map:5,weight_table:6,level_0:7,level_1:8,level_2:9,level_3:10,level_4:15,level_5:16,surface_image:17,normal_map:11,finish_map:12,emission_map:13,reflectance_table:14,particle_image:18,wave_grids:19,wave_grid:20,ripple_tile:21,hemispheres:22,factors_x:23,factors_y:24},Sr={vertex:0,vertex_normal:1,uv:2,tint:3,tangent:4,finish:5,emission:6,place:8,extent:9,traits:10},vs=class{constructor(e){this.gl=e}gl;programs=new Map;get(e,t,r=e){let s=e+JSON.stringify(t),n=this.programs.get(s);return n||this.programs.set(s,n=Wm(this.gl,e,t,r)),n}};function Hc(i,e){if(e.has(i))return"";e.add(i);let t=Bm[i];return t===void 0?`#error no shader file ${i}`:t.replace(/^#include "([\w.]+)"$/gm,(r,s)=>Hc(s,e))}function Wm(i,e,t,r){let s=Object.entries(t).map(([a,o])=>`#define ${a} ${o}
`),n=i.createProgram();for(let[a,o]of[[i.VERTEX_SHADER,`${r}.vert.glsl`],[i.FRAGMENT_SHADER,`${e}.frag.glsl`]]){let l=i.createShader(a);i.shaderSource(l,Hm+s.join("")+Hc(o,new Set)),i.compileShader(l),i.attachShader(n,l)}for(let[a,o]of Object.entries(Sr))i.bindAttribLocation(n,o,a);if(i.linkProgram(n),!i.getProgramParameter(n,i.LINK_STATUS)){let a=(i.getAttachedShaders(n)??[]).map(o=>i.getShaderInfoLog(o));throw new Error(`${e}: ${i.getProgramInfoLog(n)} ${a.join(" ")}`)}i.useProgram(n);for(let[a,o]of Object.entries(Er)){let l=i.getUniformBlockIndex(n,a);l!==i.INVALID_INDEX&&i.uniformBlockBinding(n,l,o)}for(let[a,o]of Object.entries(te))i.uniform1i(i.getUniformLocation(n,a),o);return n}var Wc={normal_map:"NORMAL_MAP",finish_map:"FINISH_MAP",emission_map:"EMISSION_MAP"},Yc=32,Ym=[["tangent","tangents",4,"SHORT"],["finish","finish",3,"FLOAT"],["emission","emissions",3,"FLOAT"]];function Xm(i,e,t){let r={};return"normal_map"in i.maps&&(r.NORMAL_MAP=1),e&&(r.MICROFACET=1,"finish_map"in i.maps&&(r.FINISH_MAP=1),i.emits&&(r.EMISSION=1),i.emits&&"emission_map"in i.maps&&(r.EMISSION_MAP=1)),t&&i.cutoff!==null&&(r.ALPHA_TEST=Math.max(1,Math.min(255,Math.round(255*i.cutoff)))),r}function Xc(i,e){for(let[t,r,s,n]of Ym){let a=i[r];a&&e(t,s,n,a)}}var _s=class{constructor(e,t,r,s){this.gl=e;this.images=r;this.textures=s;this.samplers=[e.CLAMP_TO_EDGE,e.REPEAT].map(a=>{let o=e.createSampler();return e.samplerParameteri(o,e.TEXTURE_MIN_FILTER,e.LINEAR_MIPMAP_NEAREST),e.samplerParameteri(o,e.TEXTURE_MAG_FILTER,e.LINEAR),e.samplerParameteri(o,e.TEXTURE_WRAP_S,a),e.samplerParameteri(o,e.TEXTURE_WRAP_T,a),o});let{reflectance:n}=t.head;this.table=n?qm(e,t.numbers(n)):null}gl;images;textures;samplers;table;use(e,t,r){if(!e)return t;let s=this.gl,n={...t,...Xm(e,"PHYSICAL"in t,"TEXTURED"in t)};for(let[a,o]of Object.entries(e.maps)){if(!(Wc[a]in n))continue;let l=Number(this.textures[o].repeats);this.bindTexture(te[a],this.images[o]),s.bindSampler(te[a],(r??this.samplers)[l])}return n.MICROFACET&&this.table&&this.bindTexture(te.reflectance_table,this.table),n}release(){for(let e of Object.keys(Wc))this.gl.bindSampler(te[e],null)}bindTexture(e,t){this.gl.activeTexture(this.gl.TEXTURE0+e),this.gl.bindTexture(this.gl.TEXTURE_2D,t),this.gl.activeTexture(this.gl.TEXTURE0)}};function qm(i,e){let t=i.createTexture();i.bindTexture(i.TEXTURE_2D,t),i.texImage2D(i.TEXTURE_2D,0,i.RGBA16F,Yc,Yc,0,i.RGBA,i.FLOAT,e);for(let r of[i.TEXTURE_WRAP_S,i.TEXTURE_WRAP_T])i.texParameteri(i.TEXTURE_2D,r,i.CLAMP_TO_EDGE);for(let r of[i.TEXTURE_MIN_FILTER,i.TEXTURE_MAG_FILTER])i.texParameteri(i.TEXTURE_2D,r,i.LINEAR);return t}var sa=class{constructor(e,t,r,s,n,a,o,l){this.index=e;this.visual=t;this.body=r;this.vertexArray=s;this.texture=n;this.repeats=a;this.hasUint32Indices=o;this.pieceRows=l;this.bodyFromMesh=Ae(t.matrix),this.pieces=l.map(([c,d])=>({instance:this,firstIndex:c,count:d,centre:[0,0,0],radius:0,corners:[],normal:[0,0,0],density:0}))}index;visual;body;vertexArray;texture;repeats;hasUint32Indices;pieceRows;pieces;worldFromMesh=Ae(new Array(16).fill(0));normals=this.worldFromMesh;isMirrored=!1;bodyFromMesh;place(e){let t=Pe(e,this.bodyFromMesh);if(t.every((n,a)=>n===this.worldFromMesh[a]))return!1;this.worldFromMesh=t,this.normals=$a(t),this.isMirrored=hn(t)<0;let[r,s]=[qc(t),qc(this.normals)];return this.pieceRows.forEach((n,a)=>{let o=this.pieces[a];o.centre=Ie(t,n.slice(2,5)),o.radius=n[5]*r;let l=[n.slice(6,9),n.slice(9,12)];o.corners=[0,1,2,3,4,5,6,7].map(d=>Ie(t,[l[d>>2][0],l[d>>1&1][1],l[d&1][2]]));let c=n.slice(12,15);o.normal=le(c,c)>0?bt(Yr(this.normals,c)):[0,0,0],o.density=n[15]*s}),!0}};function qc(i){let e=[0,1,2].map(r=>[i[r],i[4+r],i[8+r]]),t=e.map(r=>e.reduce((s,n)=>s+Math.abs(le(r,n)),0));return Math.sqrt(Math.max(...t))}var ys=class i{constructor(e,t){this.head=e;this.gl=t}head;gl;instances=[];version=0;patterns=[];maps=null;bodies=new Map;radii=new Map;sand=[];static async load(e,t){let r=new i(t.head,e);if(r.place(new Map),!e)return r;let{meshes:s,textures:n,bodies:a,projector:o}=t.head,l=await Promise.all(n.map(({repeats:h},m)=>$m(e,t,m,m!==o?.pattern&&h)));o&&r.patterns.push(l[o.pattern]),r.maps=new _s(e,t,l,n);let c=s.map((h,m)=>jm(e,t,m)),d=c.map(({vertexArray:h})=>h);for(let h of t.head.sand??[]){let m=t.numbers(s[h.mesh].positions);r.sand.push({heap:new gs(h,m),...c[h.mesh]})}for(let h of a)for(let m of h.visuals){let{texture:v,mesh:y}=m,w=v===null?null:l[v],x=v!==null&&n[v].repeats,S=s[y].triangles[2]==="u4",[E,T]=[r.instances.length,s[y].pieces];r.instances.push(new sa(E,m,h.name,d[y],w,x,S,T))}return r.place(new Map),r}place(e){for(let r of this.head.bodies)this.bodies.set(r.name,e.get(r.name)??st(r.pose));let t=!1;for(let r of this.instances)t=r.place(this.body(r.body))||t;t&&(this.version+=1,this.computeRadii())}setSand(e,t){let{gl:r}=this,{heap:s,positions:n,normals:a}=this.sand[e]??{};if(!r||!s||!n||!a||!(t instanceof Float32Array?s.set(t):s.apply(t)))return;let o=s.surface();r.bindBuffer(r.ARRAY_BUFFER,n),r.bufferData(r.ARRAY_BUFFER,o.positions,r.STATIC_DRAW),r.bindBuffer(r.ARRAY_BUFFER,a),r.bufferData(r.ARRAY_BUFFER,o.normals,r.STATIC_DRAW),this.version+=1}heights(e){return this.sand[e]?.heap.heights??new Float32Array}body(e){return this.bodies.get(e)??st([0,0,0,1,0,0,0])}worldFromMount(e){let t=st(e.pose);return e.body===null?t:Pe(this.body(e.body),t)}radius(e){return this.radii.get(e.visual.part)??0}computeRadii(){let e=new Map;for(let{visual:t,pieces:r}of this.instances){let s=e.get(t.part)??[1/0,1/0,1/0,-1/0,-1/0,-1/0];for(let{centre:n,radius:a}of r)for(let o=0;o<3;++o)s[o]=Math.min(s[o],n[o]-a),s[3+o]=Math.max(s[3+o],n[o]+a);e.set(t.part,s)}for(let[t,r]of e)this.radii.set(t,Math.max(r[3]-r[0],r[4]-r[1],r[5]-r[2])/2)}};function jm(i,e,t){let r=e.head.meshes[t],s=i.createVertexArray();i.bindVertexArray(s);let n=(c,d,h,m)=>{let v=i.createBuffer();return i.bindBuffer(i.ARRAY_BUFFER,v),i.bufferData(i.ARRAY_BUFFER,m,i.STATIC_DRAW),i.enableVertexAttribArray(Sr[c]),i.vertexAttribPointer(Sr[c],d,h,h!==i.FLOAT,0,0),v},a=c=>e.numbers(c),o=n("vertex",3,i.FLOAT,a(r.positions)),l=n("vertex_normal",3,i.SHORT,a(r.normals));return n("tint",3,i.UNSIGNED_SHORT,a(r.tints)),r.uvs&&n("uv",2,i.FLOAT,a(r.uvs)),Xc(r,(c,d,h,m)=>n(c,d,i[h],a(m))),i.bindBuffer(i.ELEMENT_ARRAY_BUFFER,i.createBuffer()),i.bufferData(i.ELEMENT_ARRAY_BUFFER,a(r.triangles),i.STATIC_DRAW),i.bindVertexArray(null),{vertexArray:s,positions:o,normals:l}}async function $m(i,e,t,r){let{type:s,bytes:n}=e.head.textures[t],a=t===e.head.projector?.pattern,o=await createImageBitmap(new Blob([e.numbers(n)],{type:s}),{imageOrientation:a?"from-image":"flipY",premultiplyAlpha:"none",colorSpaceConversion:"none"}),l=i.createTexture();i.bindTexture(i.TEXTURE_2D,l),i.texImage2D(i.TEXTURE_2D,0,i.RGBA8,i.RGBA,i.UNSIGNED_BYTE,o);let c=r?i.REPEAT:i.CLAMP_TO_EDGE;return i.texParameteri(i.TEXTURE_2D,i.TEXTURE_WRAP_S,c),i.texParameteri(i.TEXTURE_2D,i.TEXTURE_WRAP_T,c),i.texParameteri(i.TEXTURE_2D,i.TEXTURE_MAG_FILTER,i.LINEAR),i.texParameteri(i.TEXTURE_2D,i.TEXTURE_MIN_FILTER,a?i.LINEAR:i.LINEAR_MIPMAP_LINEAR),a||i.generateMipmap(i.TEXTURE_2D),o.close(),l}var Km=["#ff5a4f","#45d96b","#4aa3ff"],Ei=.02,xi=11,Qm=[0,1,-1,2,-2,3,-3,4,-4,5,-5],na=class{constructor(e,t,r){this.context=e;this.intrinsics=r;this.cameraFromWorld=ft(t)}context;intrinsics;labelBoxes=[];cameraFromWorld;line(e,t,r=1.5,s=[]){let{context:n}=this;n.strokeStyle=t,n.lineWidth=r,n.setLineDash(s),n.beginPath();let a=null;for(let o of e){let l=Ie(this.cameraFromWorld,o);if(a&&(a[2]<-Ei||l[2]<-Ei)){let[c,d]=[jc(a,l),jc(l,a)];n.moveTo(...this.pixel(c)),n.lineTo(...this.pixel(d))}a=l}n.stroke()}project(e){let t=Ie(this.cameraFromWorld,e);return t[2]<-Ei?this.pixel(t):null}label(e,t,r="#ffffff"){let s=this.project(e);if(!s)return;let{context:n}=this;n.font=`${xi}px system-ui, sans-serif`;let a=this.findSpot(s,n.measureText(t).width);if(!a)return;let[o,l]=a;Math.abs(l-s[1])>2*xi&&this.drawLeader(s,[o-2,l-xi/3],r),n.lineWidth=3,n.setLineDash([]),n.strokeStyle="rgba(0, 12, 24, 0.75)",n.strokeText(t,o,l),n.fillStyle=r,n.fillText(t,o,l)}findSpot([e,t],r){for(let s of Qm)for(let n of[e+5,e-5-r]){let a=t-5+s*(xi+3),o=[n-2,a-xi,n+r+2,a+3];if(!this.labelBoxes.some(l=>o[0]<l[2]&&o[2]>l[0]&&o[1]<l[3]&&o[3]>l[1]))return this.labelBoxes.push(o),[n,a]}return null}drawLeader(e,t,r){let{context:s}=this;s.strokeStyle=r,s.lineWidth=.75,s.setLineDash([]),s.beginPath(),s.moveTo(...e),s.lineTo(...t),s.stroke()}dot(e,t,r){let s=this.project(e);s&&(this.context.fillStyle=t,this.context.beginPath(),this.context.arc(s[0],s[1],r,0,2*Math.PI),this.context.fill())}pixel([e,t,r]){let{fx:s,fy:n,cx:a,cy:o,skew:l}=this.intrinsics;return[a+(s*e+l*t)/-r+.5,o-n*t/-r+.5]}};function jc(i,e){if(i[2]<-Ei)return i;let t=(-Ei-i[2])/(e[2]-i[2]);return i.map((r,s)=>r+t*(e[s]-r))}function $c(i,e,t,r,s,n,a,o){let l=new na(i,e,t);for(let{name:c,at:d,colour:h,lines:m}of n.markers(a.time)){for(let v of m)l.line(v,h);m.length||l.dot(d,h,3),(o.labels||!m.length)&&l.label(d,c)}if(o.trails&&Jm(l,r,n,a),o.sonars)for(let c of r.sensors)ep(l,c,s.worldFromMount(c),a);if(o.frames)Zm(l,r,s,o.labels);else if(o.labels)for(let{name:c,body:d}of r.vehicles)l.label(ve(s.body(d)),c);for(let c of a.points("contacts",["x","y","z"]))l.dot(c,"#ffb02e",4);for(let{name:c,body:d}of r.vehicles)tp(l,c,s.body(d),a)}function Jm(i,e,t,r){let s=e.vehicles.map(({body:a})=>a),n=e.bodies.filter(a=>a.vehicle===null).map(({name:a})=>a);for(let a of[...s,...n]){let o=r.poses.get(a);if(!o)continue;let l=t.trail(a,r.time);i.line([...l,ve(o)],"rgba(255, 214, 92, 0.9)",1.5)}}function Zm(i,e,t,r){let s=e.vehicles.length>1,n=new Map(e.bodies.map(({name:a,vehicle:o})=>[a,o??""]));for(let{name:a,body:o,pose:l}of e.frames){let c=t.worldFromMount({body:o,pose:l}),d=o===null?1:.25;Km.forEach((m,v)=>{let y=[0,1,2].map(w=>w===v?d:0);i.line([ve(c),Ie(c,y)],m,2)});let h=s&&o!==null?`${n.get(o)} `:"";r&&i.label(ve(c),h+a.split("/").at(-1))}}function ep(i,e,t,r){let s="rgba(120, 220, 255, 0.8)",n=r.signal(`range/${e.name}`);if(e.kind==="range"){let l=n??e.reach,c=Ie(t,[l,0,0]);i.line([ve(t),c],s,1.5,n===void 0?[4,4]:[]),n!==void 0&&i.dot(c,"#78dcff",3),n!==void 0&&i.label(c,`${n.toFixed(2)} m`,"#bfeeff");return}let a=l=>e.kind==="fan"?[0,Math.sin(l),-Math.cos(l)]:[Math.cos(l),Math.sin(l),0],o=Array.from({length:33},(l,c)=>{let d=e.from+(e.to-e.from)*c/32;return Ie(t,a(d).map(h=>h*e.reach))});i.line([ve(t),...o,ve(t)],s,1)}function tp(i,e,t,r){let s=["x","y","z"].map(d=>r.signal(`water/${e}/${d}`)??0),n=Math.hypot(...s);if(n<.005)return;let a=Me(ve(t),[0,0,.55]),o=Me(a,s,(.5+2*n)/n),l=[-s[1]/n,s[0]/n,0],c=Me(o,s,-.15/n);i.line([a,o],"#5ee6d0",2.5),i.line([Me(c,l,.08),o,Me(c,l,-.08)],"#5ee6d0",2.5),i.label(o,`current ${n.toFixed(2)} m/s`,"#b9fff1")}function aa(i,e,t,r,s,n){let a=t.fx/e.fx;for(let[o,l,c]of[["truth","#45f08b",[]],["estimate","#ff9f43",[6,4]]]){let d=n.points(`${o}/${e.name}`,["u","v"]);if(!(d.length<2)){i.strokeStyle=l,i.lineWidth=2,i.setLineDash([...c]),i.beginPath();for(let[h,m]of d)i.lineTo(r+t.cx+(h-e.cx)*a+.5,s+t.cy+(m-e.cy)*a+.5);i.closePath(),i.stroke(),i.setLineDash([])}}}function Kc(i,e,t,r){let[s,n]=[28,r+22],a=rp(130*t/e.fx),o=a*e.fx/t;i.save(),i.setLineDash([]),i.shadowColor="rgba(0, 12, 24, 0.9)",i.shadowBlur=3,i.fillStyle=i.strokeStyle="#ffffff",i.textAlign="center",i.font="600 13px system-ui, sans-serif",i.fillText("N",s,n),i.beginPath(),i.moveTo(s,n+6),i.lineTo(s+8,n+28),i.lineTo(s,n+23),i.lineTo(s-8,n+28),i.closePath(),i.fill();let[l,c]=[18,n+58];i.lineWidth=2,i.beginPath(),i.moveTo(l,c-6),i.lineTo(l,c),i.lineTo(l+o,c),i.lineTo(l+o,c-6),i.stroke(),i.fillText(a<1?`${Math.round(100*a)} cm`:`${a} m`,l+o/2,c-8),i.restore()}function rp(i){let e=10**Math.floor(Math.log10(i)),t=[5,2,1].find(r=>r*e<=i*(1+1e-9))??1;return Number((t*e).toPrecision(1))}var bs=class{constructor(e){this.gl=e}gl;fence=null;beginTime=0;pauseEnd=0;responsiveEnd=0;begin(){this.fence&&this.gl.deleteSync(this.fence),this.fence=this.gl.fenceSync(this.gl.SYNC_GPU_COMMANDS_COMPLETE,0),this.gl.flush(),this.beginTime=performance.now()}skipPauses(){this.responsiveEnd=performance.now()+300}isReady(e){let{gl:t,fence:r}=this,s=t.isContextLost()||e-this.beginTime>2e3;return r&&(s||t.getSyncParameter(r,t.SYNC_STATUS)===t.SIGNALED)&&(t.deleteSync(r),this.fence=null,this.pauseEnd=Math.min(2*e-this.beginTime,e+100)),!this.fence&&(e>=this.pauseEnd||e<this.responsiveEnd)}};var ip=.3,oa=.05,sp=Math.SQRT2,ca=Ae([.5,0,0,.5,0,.5,0,.5,0,0,.5,.5,0,0,0,1]);function np(i){let e=[0,4,8,12].map(r=>[i[r],i[r+1],i[r+2],i[r+3]]);return[1,-1].flatMap(r=>[0,1,2].map(s=>e[3].map((n,a)=>n+r*e[s][a]))).map(r=>{let s=Math.hypot(r[0],r[1],r[2]);return r.map(n=>n/s)})}function ws(i,e){let t=np(e.clip),r=ft(e.worldFromCamera),s=[];for(let n of i){let a=Ie(r,n.centre);if(!t.every(l=>le(l,a)+l[3]+n.radius>0))continue;let o=n.corners.map(l=>Ie(r,l));t.every(l=>o.some(c=>le(l,c)+l[3]>0))&&s.push([Math.hypot(...a)+n.radius,n])}return s.sort((n,a)=>n[0]-a[0]).map(([,n])=>n)}function Qc(i,e,t,r){let s=ap(t),n=ve(r.worldFromCamera),a=[r.worldFromCamera[2],r.worldFromCamera[6],r.worldFromCamera[10]],o=op(r),l=e.map(c=>{let d=c.corners.map(w=>le(Me(n,w,-1),a)),m=[Math.max(0,Math.min(...d)),Math.max(0,Math.max(...d))].flatMap(w=>o.map(x=>Me(n,x,w))),[v,y]=[la(c.corners,s),la(m,s)];return v.map(([w,x],S)=>[Math.max(w,y[S][0]),Math.min(x,y[S][1])])});return i.filter(c=>{let d=la(c.corners,s);return l.some(h=>[0,1].every(m=>d[m][0]<=h[m][1]+oa&&d[m][1]>=h[m][0]-oa)&&d[2][1]>=h[2][0]-oa)})}function ap(i){return i[2]<ip?[...Jc(i),i]:[[1,0,-i[0]/i[2]],[0,1,-i[1]/i[2]],i]}function la(i,e){return e.map(t=>{let r=i.map(s=>le(t,s));return[Math.min(...r),Math.max(...r)]})}function op({clip:i,worldFromCamera:e}){return[[-1,-1],[-1,1],[1,-1],[1,1]].map(([r,s])=>{let n=(s+i[6])/i[5],a=(r+i[2]-i[1]*n)/i[0];return[e[0]*a+e[1]*n-e[2],e[4]*a+e[5]*n-e[6],e[8]*a+e[9]*n-e[10]]})}function Jc(i){let e=[-i[0],-i[1],-i[2]],t=bt(it(e,Math.abs(i[2])<.9?[0,0,1]:[1,0,0]));return[t,it(t,e)]}function Zc(i,e){let t=[...Jc(e),[-e[0],-e[1],-e[2]]],r=[1/0,1/0,1/0],s=[-1/0,-1/0,-1/0];for(let{centre:d,radius:h}of i)t.forEach((m,v)=>{r[v]=Math.min(r[v],le(m,d)-h),s[v]=Math.max(s[v],le(m,d)+h)});let n=Math.max(s[0]-r[0],s[1]-r[1])/2,a=20,o=[1/n,1/n,2/(s[2]+a-r[2])],l=[(r[0]+s[0])/2,(r[1]+s[1])/2,(s[2]+a+r[2])/2],c=t.flatMap((d,h)=>[d[0]*o[h],d[1]*o[h],d[2]*o[h],-o[h]*l[h]]);return[Ae([...c,0,0,0,1]),2*n]}function ef(i,e){if(!(i.density>0)||le(i.normal,i.normal)===0)return!1;let t=ft(e.worldFromCamera),r=i.corners.map(h=>Ie(t,h)),s=Vi(e.worldFromCamera,i.normal),n=r.map(h=>-h[2]);if(Math.min(...n)<=0)return!1;let a=Math.min(...r.map(h=>Math.abs(le(s,h)))),o=Math.max(...r.map(h=>Math.hypot(...h))),l=Math.hypot(s[0],s[1]),c=Math.min(e.intrinsics.fx,e.intrinsics.fy),d=Math.max(...n)/c*(1+l*o/a);return i.density*d<=sp}var xs=512,tf=1024,lp=.008,Ft=512,cp=80*Math.PI/180,rf=1.02,fp=1024,Si=class{constructor(e,t,r){this.gl=e;this.width=t;this.height=r;this.texture=e.createTexture(),e.bindTexture(e.TEXTURE_2D,this.texture),e.texStorage2D(e.TEXTURE_2D,1,e.DEPTH_COMPONENT24,t,r);for(let[s,n]of[[e.TEXTURE_COMPARE_MODE,e.COMPARE_REF_TO_TEXTURE],[e.TEXTURE_COMPARE_FUNC,e.LEQUAL],[e.TEXTURE_MIN_FILTER,e.LINEAR],[e.TEXTURE_MAG_FILTER,e.LINEAR],[e.TEXTURE_WRAP_S,e.CLAMP_TO_EDGE],[e.TEXTURE_WRAP_T,e.CLAMP_TO_EDGE]])e.texParameteri(e.TEXTURE_2D,s,n);this.buffer=e.createFramebuffer(),e.bindFramebuffer(e.FRAMEBUFFER,this.buffer),e.framebufferTexture2D(e.FRAMEBUFFER,e.DEPTH_ATTACHMENT,e.TEXTURE_2D,this.texture,0),e.drawBuffers([e.NONE]),this.begin(0,0,t,r)}gl;width;height;texture;buffer;begin(e,t,r,s){let n=this.gl;n.bindFramebuffer(n.FRAMEBUFFER,this.buffer),n.viewport(e,t,r,s),n.enable(n.SCISSOR_TEST),n.scissor(e,t,r,s),n.depthMask(!0),n.clearDepth(1),n.clear(n.DEPTH_BUFFER_BIT),n.disable(n.SCISSOR_TEST)}},Es=class{constructor(e,t,r){this.gl=e;this.programs=t;this.instanceBlocks=r;let s=[xs,tf].map(n=>[n,new Si(e,n,n)]);this.suns=Object.fromEntries(s),this.sunMap=this.suns[xs]}gl;programs;instanceBlocks;suns;sunMap;textureFromWorld=Ae([1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]);lift=0;lampMaps=null;projectorMap=null;sunKey="";lampKeys=[];updateSunShadows(e,t,r){let s=`${r} ${t} ${e.map(l=>`${l.instance.index}.${l.firstIndex}`)}`;if(s===this.sunKey)return;this.sunKey=s;let[n,a]=Zc(e,t),o=a/xs<=lp?xs:tf;this.sunMap=this.suns[o],this.textureFromWorld=Pe(ca,n),this.lift=1.5*a/o,this.sunMap.begin(0,0,o,o),this.draw(e,n)}updateLampShadows(e,t,r){this.lampMaps??=new Si(this.gl,2*Ft,2*Ft),e.forEach(({lamp:s,worldFromLamp:n},a)=>{let o=s.shadow?`${r} ${s.half_angle} ${n}`:"none";if(o===this.lampKeys[a])return;this.lampKeys[a]=o;let[l,c]=[a%2,a>>1];this.lampMaps.begin(Ft*l,Ft*c,Ft,Ft),s.shadow&&this.drawShadowMap(n,sf(s),t)})}updateProjectorShadows(e,t,r){this.projectorMap??=new Si(this.gl,t.width,t.height),this.projectorMap.begin(0,0,t.width,t.height),this.drawShadowMap(e,t,r)}drawShadowMap(e,t,r){let s=er(t,!0),n=ws(r,{worldFromCamera:e,clip:s,intrinsics:t});this.draw(n.filter(Ai),Pe(s,ft(e)),!0)}draw(e,t,r=!1){let s=this.gl;s.enable(s.DEPTH_TEST),s.depthFunc(s.LEQUAL),s.enable(s.POLYGON_OFFSET_FILL),s.polygonOffset(1.5,2),s.useProgram(this.programs.get("shadow",{})),this.instanceBlocks.fill(t);for(let n of e)this.instanceBlocks.drawPiece(n,r);s.disable(s.POLYGON_OFFSET_FILL)}};function Ai(i){return i.instance.visual.opacity>=1}function sf(i){let e=Ft/2/(rf*Math.tan(Math.min(i.half_angle,cp))),t=(Ft-1)/2,[r,s]=[Ft,Ft];return{width:r,height:s,fx:e,fy:e,cx:t,cy:t,skew:0,near:.1,far:20}}function nf(i,e,t){let r=fp/Math.max(t,e),s=Math.max(1,Math.round(r*e)),n=Math.max(1,Math.round(r*t)),a=Math.tan(i.fovy/2);return{width:s,height:n,fx:s/2/(a*e/t),fy:n/2/a,cx:(s-1)/2,cy:(n-1)/2,skew:0,near:.1,far:20}}function af(i,e){let t=new Float32Array(112),r=ft(e);return i.forEach(({lamp:s,worldFromLamp:n},a)=>{let[o,l]=[.25+.5*(a%2),.25+.5*(a>>1)],c=Ae([.25,0,0,o,0,.25,0,l,0,0,.5,.5,0,0,0,1]),d=Pe(c,er(sf(s),!0));t.set(wt(Pe(Pe(d,ft(n)),e)),16*a);let h=Pe(r,n),m=Math.cos(s.half_angle),v=Math.cos((1-s.softness)*s.half_angle),y=2*rf*Math.tan(s.half_angle)/Ft,w=h;t.set([...ve(w),m],64+4*a),t.set([w[2],w[6],w[10],1/Math.max(v-m,1e-5)],80+4*a),t.set([...s.colour.map(x=>x*s.intensity),1.5*y],96+4*a)}),t}function of(i,e,t,r){let s=Pe(ft(e),r),n=Pe(ca,er(t,!0)),a=ft(s);return Float32Array.from([...wt(Pe(n,s)),...ve(a),i.laser?1:0,a[2],a[6],a[10],1.5/Math.min(t.fx,t.fy)])}function lf(i,e,t,r,s){let{fx:n,fy:a,cx:o,cy:l,skew:c}=e,[d,h]=[1/n,-1/a],m=c*h/n,v=h*(-.5-l),y=d*(-.5-o)-c*v/n,w=S=>S.map(E=>r*E),x=new Float32Array(76);return x.set([...i.absorption,i.field[0],...i.scattering,i.field[1],...Array.from({length:8},(S,E)=>s[E]??0),0,i.exposure,i.scale,0,...w(i.beam),0,...i.beam_loss,0,...w(i.total),0,...i.loss,0,...i.reflectance,i.sun[2],...i.phase,y,v,-1,0,d,0,0,0,-m,h,0,0]),t.forEach(({lamp:S,index:E},T)=>{let A=Math.cos(S.half_angle);x.set([...i.lamps[E],A*A,+(S.half_angle<Math.PI/2)],4*(15+T))}),x}var[up,hp]=[.0625,.1875],dp=.1875,mp=24;function cf(i,e,t){let r=Math.sqrt(i.fx*i.fy),s=Math.min(Math.round(Math.log(Math.max(.41*r,1))/Math.log(2.6)),7);if(!t||s<1)return{deviations:[],spreads:[],reach:[],highestFrequency:120};let n=(.41*r)**(1/s),a=Array.from({length:s+1},(l,c)=>n**c),o=a.map(l=>l/r);return{deviations:o,spreads:a.map(gp),reach:o.map(l=>pp(l,e,i)),highestFrequency:Math.min(120,.3*r)}}function ff(i){return{RADIUS:uf(i),SPREAD:Math.round(1e3*i)}}function uf(i){return i>0?Math.min(Math.ceil(3*i),mp):0}function pp(i,e,t){let[r,s]=[t.width/t.fx/2,t.height/t.fy/2],n=[r,s].map(o=>e.map(l=>Math.min(i*l,o)**2)),a=0;for(let o of n[0])for(let l of n[1])a+=Math.sqrt(1+o+l);return e.length**2/a}function gp(i,e){let[t,r]=[0,0];for(let n=0;n<=e;++n)t=t/4+(n<2?up:hp),r=r/4+dp;let s=(i/2**(e+1))**2-t-r;return s>.01?vp(s):0}function vp(i){let[e,t]=[.1,2*Math.sqrt(i)+1];for(;t-e>5e-4;){let r=(e+t)/2,[s,n]=[1,0];for(let a=1;a<=uf(r);++a){let o=2*Math.exp(-a*a/(2*r*r));s+=o,n+=o*a*a}n<i*s?e=r:t=r}return Math.round(500*(e+t))/1e3}function hf(i,e,t){let r=new Float32Array(4*t*128),s=Math.log(e.highestFrequency/.5)/35,n=Array.from({length:36},(l,c)=>.5*Math.exp(c*s)),a=n.map(l=>_p(i,l)),o=[0,...e.deviations].map(l=>n.map(c=>Math.exp(-2*(Math.PI*c*l)**2)));for(let l=0;l<128;++l){let c=l/127,d=i.scale*c/Math.max(1-c,1e-6);for(let h=0;h<3;++h){let[m,v]=[i.absorption[h],i.scattering[h]],y=i.field[0]+i.field[1]*Math.sqrt(m*d),[w,x]=[Math.exp(-(m+v)*d),Math.exp(-d*m-y*v*d)];if(!(x-w>1e-9))continue;let S=a.map(T=>{let A=(T/i.forward)**12;return Math.exp(d*(v*(T-(y-(1-i.forward))*A)-(m+v)))});yp(o,S,w,x).forEach((T,A)=>r[4*(128*A+l)+h]=T)}}return r}function _p({transform:i},e){let{values:t,min_frequency:r,max_frequency:s}=i,n=Math.log(e/r)/Math.log(s/r)*(t.length-1),a=Math.min(Math.max(Math.floor(n),0),t.length-2);return t[a]+(n-a)*(t[a+1]-t[a])}function yp(i,e,t,r){let s=i.map(m=>[...m.map((v,y)=>v/e[y]),1e3/r]),n=[...e.map(m=>(m-t)/m),1e3*(r-t)/r],a=(m,v)=>m.reduce((y,w,x)=>y+w*v[x],0),o=s.map(m=>a(m,n)),l=s.map((m,v)=>s.map((y,w)=>a(m,y)*(v===w?1+1e-9:1))),c=i.map(()=>0),d=i.map((m,v)=>v);for(;d.length;){let m=bp(d.map(y=>[...d.map(w=>l[y][w]),o[y]])),v=Math.min(...m);if(v>=0){d.forEach((y,w)=>c[y]=m[w]);break}d=d.filter((y,w)=>w!==m.indexOf(v))}let h=c.reduce((m,v)=>m+v,0);return h>0?c.map(m=>m*(r-t)/h):c}function bp(i){let e=i.length;for(let r=0;r<e;++r){let s=r;for(let n=r+1;n<e;++n)Math.abs(i[n][r])>Math.abs(i[s][r])&&(s=n);[i[r],i[s]]=[i[s],i[r]];for(let n=r+1;n<e;++n){let a=i[n][r]/i[r][r];for(let o=r;o<=e;++o)i[n][o]-=a*i[r][o]}}let t=new Array(e).fill(0);for(let r=e-1;r>=0;--r){let s=i[r][e];for(let n=r+1;n<e;++n)s-=i[r][n]*t[n];t[r]=s/i[r][r]}return t}var ii=[41,31],wp=Math.sqrt(1-1/1.34**2),xp=.05,Ep=.1,df=.84,mf=60,pf=1e9;function vf(i,e,t,r,s,n){let[a,o]=ii,l=new Float32Array(4*a*o),{fx:c,fy:d,cx:h,cy:m,skew:v,width:y,height:w}=t,x=fa(i,Math.max(r,0),s,n);for(let S=0;S<o;++S)for(let E=0;E<a;++E){let T=-(w*S/(o-1)-.5-m)/d,A=(y*E/(a-1)-.5-h-v*T)/c;l.set(x(Yr(e,bt([A,T,-1]))),4*(a*S+E))}return l}function fa(i,e,t,r){let{sun:s,open_water:n}=i,a=i.total.map((l,c)=>l*Math.exp(-i.loss[c]*e)),o=i.beam.map((l,c)=>Math.min(l*Math.exp(-i.beam_loss[c]*e),a[c]));return l=>{let c=l[2],d=c>0?Math.min(e/Math.max(c,1e-6),pf):pf,h=le(l,s),m=Ap(n.asymmetry,h),v=3*(1+df*h*h)/(4*Math.PI*(3+df)),y=.5+(.5-n.backscatter)*c/Math.sqrt(c*c+Ep);return[0,1,2].map(w=>{let x=n.attenuation[w],S=n.scattering[w],E=n.molecules[w],T=o[w]*(Math.PI/s[2])*(S*m+E*v)*gf(x*(1-c/s[2]),d),A=i.reflectance[w]*a[w],G=a[w]-o[w],I=(S*(y*G+(1-y)*A)+.5*E*(G+A))*gf(x-i.loss[w]*c,d),D=c>0&&!r?Sp(i,w,c)*Math.exp(-Math.min(x*d,700)):0;return t*(T+I+D)})}}function Sp(i,e,t){let r=Math.min(Math.max((t-wp)/(2*xp)+.5,0),1),s=r*r*(3-2*r);return s*i.open_water.window+(1-s)*i.reflectance[e]*i.total[e]}function Ap(i,e){let t=i,r=Math.sqrt(1+t*t-2*t*Math.min(Math.max(e,-1),1));return(1-t*t)/(4*Math.PI*r**3)}function gf(i,e){let t=Math.min(Math.max(i*e,-mf),mf);return Math.abs(t)<1e-4?e*(1-t/2):(1-Math.exp(-t))/i}var Mp=[2654435769,2135587861],[Tp,Rp]=[[3210233709,484763065],[2496678331,321982955]],Lp=[[3605593784,1717173651],[2692095332,2025677871],[3875765969,2696161499]];function _f(i){return[parseInt(i.slice(2,10),16),parseInt(i.slice(10),16)]}function yf(i){let e=Ss([i[0]^i[0]>>>30,i[1]^(i[1]>>>30|i[0]<<2)],Tp),t=Ss([e[0]^e[0]>>>27,e[1]^(e[1]>>>27|e[0]<<5)],Rp);return[(t[0]^t[0]>>>31)>>>0,(t[1]^(t[1]>>>31|t[0]<<1))>>>0]}function As(i,...e){return e.reduce((t,r,s)=>yf(bf(t,Ss(Pp(r),Lp[s]))),i)}function St(i,e){let[t,r]=yf(bf(i,Ss([0,e+1],Mp)));return(t*2**21+(r>>>11))*2**-53}function Pp(i){return[Math.floor(i/2**32)>>>0,i>>>0]}function bf(i,e){let t=(i[1]>>>0)+(e[1]>>>0);return[i[0]+e[0]+ +(t>=2**32)>>>0,t>>>0]}function Ss(i,e){let[t,r,s,n]=[i[1]&65535,i[1]>>>16,e[1]&65535,e[1]>>>16],a=r*s+(t*s>>>16),o=t*n+(a&65535);return[r*n+Math.floor(a/65536)+Math.floor(o/65536)+Math.imul(i[0],e[1])+Math.imul(i[1],e[0])>>>0,Math.imul(i[1],e[1])>>>0]}var qt=10,ua=2e4,Ip=4e6,[kp,Fp,Cp]=[.02,4,3],[Sf,Op,Np,Dp,Up]=[64,.25,2,.02,.08],wf=.5,Vp=0,[zp,Gp,Bp,Hp]=[.02,9,.1,4];function Ms(i,e,t,r,s){let n=i.classes.map(a=>{let o=new ha(a,i,e,t,r);if(a.concentration>0)if(a.is_plume)Yp(o,i.source,s);else for(xf(o,s);o.isFull;)o.shorten(),xf(o,s);return o.records});return Float32Array.from(n.flat())}var ha=class{constructor(e,t,r,s,n){this.sizeClass=e;this.drift=r;this.m=s;this.key=_f(e.key),this.focal=Math.sqrt(n.fx*n.fy);let a=e.is_plume?t.range*Hp:t.range;this.reach=Math.min(a,e.max_diameter*this.focal/wf,n.far);let[o,l]=[(n.cy+.5)/n.fy,(n.cy+.5-n.height)/n.fy],c=Math.abs(n.skew)/n.fx*Math.max(Math.abs(o),Math.abs(l)),[d,h]=[-(n.cx+.5)/n.fx-c,(n.width-.5-n.cx)/n.fx+c];this.slopes=[d,h,l,o];let{velocity:m}=r;this.motion=this.toCamera(m[0],m[1],m[2]+e.rise_speed).map(v=>v*t.exposure_time)}sizeClass;drift;m;records=[];key;slopes;focal;reach;motion;get isFull(){return this.records.length>=qt*ua}shorten(){let[e,t,r,s]=this.slopes,n=.9*ua/this.sizeClass.concentration;this.reach=Math.min(Math.cbrt(3*n/((t-e+.05)*(s-r+.05))),.7*this.reach),this.records.length=0}toCamera(e,t,r){let{m:s}=this;return[s[0]*e+s[4]*t+s[8]*r,s[1]*e+s[5]*t+s[9]*r,s[2]*e+s[6]*t+s[10]*r]}mayContain([e,t,r],s){let{slopes:n}=this;if(r>s||e*e+t*t+r*r>(this.reach+s)**2)return!1;let a=n.map(o=>s*Math.hypot(1,o));return n[0]*-r-e<=a[0]&&e-n[1]*-r<=a[1]&&n[2]*-r-t<=a[2]&&t-n[3]*-r<=a[3]}diameterOf(e){let{min_diameter:t,max_diameter:r,slope:s}=this.sizeClass,n=(r/t)**(1-s);return t*(1+e*(n-1))**(1/(1-s))}add([e,t,r],s,n,a){let{slopes:o,sizeClass:l,motion:c}=this;if(-r<Up)return;let d=s-.02*r+.5*(Math.abs(c[0])+Math.abs(c[1])+Math.abs(c[2]));if(e<o[0]*-r-d||e>o[1]*-r+d||t<o[2]*-r-d||t>o[3]*-r+d)return;let h=Math.hypot(e,t,r)/Math.min(this.reach,s*this.focal/wf);if(h>=1||this.isFull)return;let m=Math.min((1-h)/Op,1),[v,y]=[c,1];if(l.kind===Vp){y=-Math.log(Math.max(St(a,0),Dp));let w=s*Np*St(a,1);v=c.map((x,S)=>x+w*(2*St(a,S+2)-1))}this.records.push(e,t,r,s/2,...v,n*m,l.reflectance*y,l.kind)}};function xf(i,e){let{m:t,sizeClass:r,drift:s,key:n}=i,{concentration:a,depth_scale:o}=r,l=Math.min(Math.max(Math.cbrt(Cp/a),kp),Fp),c=Math.min(a*l**3,Sf/2),d=[0,0,r.rise_speed*s.time],h=[t[3],t[7],t[11]].map((x,S)=>x-(s.displacement[S]+d[S])),[m,v]=Ef(i,h,l);for(;m.reduce((x,S,E)=>x*(v[E]-S+1),1)>Ip;)i.reach*=.7,[m,v]=Ef(i,h,l);let y=.8660254037844387*l+r.max_diameter,w=e-t[11];for(let x=m[0];x<=v[0]&&!i.isFull;++x)for(let S=m[1];S<=v[1];++S)for(let E=m[2];E<=v[2];++E){let T=i.toCamera((x+.5)*l-h[0],(S+.5)*l-h[1],(E+.5)*l-h[2]);if(!i.mayContain(T,y))continue;let A=As(n,x,S,E),G=Wp(St(A,0),c);for(let I=0;I<G;++I){let D=1+5*I,[U,Y,X]=[x,S,E].map((z,J)=>(z+St(A,D+J))*l-h[J]),P=w-X;if(P<0)continue;let K=o===null?1:Math.exp(-P/o)-St(A,D+4);if(K<=0)continue;let V=o===null?1:Math.min(K/.05,1),j=i.diameterOf(St(A,D+3));i.add(i.toCamera(U,Y,X),j,V,As(A,I,0,0))}}}function Ef({slopes:i,reach:e,m:t},r,s){let n=Math.hypot(Math.max(...i.slice(0,2).map(Math.abs)),Math.max(...i.slice(2).map(Math.abs))),a=Math.atan(n),o=[0,1,2].map(l=>{let c=Math.acos(Math.min(Math.max(-t[4*l+2],-1),1)),d=c<=a?1:Math.cos(c-a),h=Math.PI-c<=a?-1:Math.cos(Math.min(c+a,Math.PI));return[e*Math.min(h,0),e*Math.max(d,0)]});return[0,1].map(l=>o.map((c,d)=>Math.floor((r[d]+c[l])/s)))}function Wp(i,e){let[t,r]=[0,Math.exp(-e)],s=r;for(;i>s&&t<Sf;)t+=1,r*=e/t,s+=r;return t}function Yp(i,e,t){let{m:r,sizeClass:s,drift:n,key:a}=i,[o,l,c]=[s.concentration,s.rise_speed,t-e[2]];if(c<=0)return;let d=Math.floor(o*n.time),h=Math.max(Math.ceil(o*(n.time-c/l)),0,d-ua+1);for(let m=h;m<=d;++m){let v=As(a,m),y=n.time-m/o,w=l*y,x=2*Math.PI*St(v,0),S=Bp*w*Math.sqrt(St(v,1)),E=2*Math.PI*St(v,2)+Gp*y,T=zp*Math.min(10*w,1),A=[S*Math.cos(x)+T*Math.cos(E),S*Math.sin(x)+T*Math.sin(E),w],[G,I,D]=A.map((U,Y)=>e[Y]+n.velocity[Y]*y+U-r[4*Y+3]);i.add(i.toCamera(G,I,D),i.diameterOf(St(v,3)),1,v)}}var Xp=1.5,da=8,qp=[4,4,2],Ts=class{constructor(e,t){this.gl=e;this.programs=t;this.records=e.createBuffer(),this.lens=e.createBuffer(),this.vertexArray=e.createVertexArray(),e.bindVertexArray(this.vertexArray),e.bindBuffer(e.ARRAY_BUFFER,this.records);let r=0;qp.forEach((s,n)=>{e.enableVertexAttribArray(da+n),e.vertexAttribPointer(da+n,s,e.FLOAT,!1,4*qt,r),e.vertexAttribDivisor(da+n,1),r+=4*s}),e.bindVertexArray(null)}gl;programs;records;lens;vertexArray;draw({spec:e,records:t},r,s){let{gl:n}=this;if(n.clearColor(0,0,0,0),n.clear(n.COLOR_BUFFER_BIT),!t.length)return;n.bindBuffer(n.UNIFORM_BUFFER,this.lens);let a=Float32Array.of(e.aperture/2,1/e.focus_distance,Xp,0);n.bufferData(n.UNIFORM_BUFFER,a,n.STREAM_DRAW),n.bindBufferBase(n.UNIFORM_BUFFER,Er.ParticleLens,this.lens),n.useProgram(this.programs.get("particle",r?{LAMPS:r,...s}:s)),n.enable(n.BLEND),n.blendFunc(n.ONE,n.ONE_MINUS_SRC_ALPHA),n.bindVertexArray(this.vertexArray),n.bindBuffer(n.ARRAY_BUFFER,this.records),n.bufferData(n.ARRAY_BUFFER,jp(t),n.STREAM_DRAW),n.drawArraysInstanced(n.TRIANGLE_STRIP,0,4,t.length/qt),n.bindVertexArray(null),n.disable(n.BLEND)}};function jp(i){let e=new Float64Array(i.length/qt);for(let s=0,n=0;s<e.length;++s,n+=qt)e[s]=i[n]**2+i[n+1]**2+i[n+2]**2;let t=Array.from(e.keys()).sort((s,n)=>e[n]-e[s]),r=new Float32Array(i.length);return t.forEach((s,n)=>r.set(i.subarray(qt*s,qt*(s+1)),qt*n)),r}var $p=16,Kp="6e4",Rs=class i{constructor(e,t,r,s){this.gl=e;this.programs=t;this.nodes=r;this.format=s?e.RGBA16F:e.RGBA32F,this.switches=s?{FAR:Kp}:{},this.particlePass=new Ts(e,t),this.map=this.texture(ii[0],ii[1],this.format)}gl;programs;nodes;switches;format;particlePass;map;tables=[];table=null;targets=new Map;currentTargets=null;radiance=null;static make(e,t,r){return["EXT_color_buffer_float","OES_texture_float_linear","EXT_float_blend"].every(n=>e.getExtension(n))?new i(e,t,r,!1):!e.getExtension("EXT_color_buffer_float")&&!e.getExtension("EXT_color_buffer_half_float")?null:new i(e,t,r,!0)}plan(e,t){return cf(e,this.nodes,t)}prepare(e,t,r,s,n,a,o){return this.table=s.deviations.length?this.tableOf(e,s):null,this.upload(this.map,ii[0],ii[1],vf(e,t,r,n,a,o)),this.bind(te.open_water_map,this.map),this.table&&this.bind(te.weight_table,this.table),this.currentTargets=this.targetsOf(r,s),this.radiance=this.currentTargets.surfaces.textures[0],this.currentTargets.surfaces.buffer}drawOver(e){let{gl:t}=this,r=this.currentTargets,{width:s,height:n}=r.surfaces,a=r.wateredSurfaces??=this.depthTarget(s,n);this.bind(te.surface_image,r.surfaces.textures[0]),this.begin(a),t.depthMask(!0),t.clear(t.DEPTH_BUFFER_BIT),e(),this.radiance=a.textures[0]}develop(e,t,r,s,n,a){let o=this.targetsOf(t,r),l=e.lamp_veil?s:0,c=this.table?{BLUR:1}:{};if((r.spreads.length||l)&&(this.drawScattered(o,r,l),this.bind(te.level_0,o.levels[0].total.textures[0]),c.SCATTERED=1),this.bind(te.surface_image,this.radiance),a){let d=o.particles??=this.target(t.width,t.height,1,this.format);this.begin(d),this.particlePass.draw(a,s,this.switches),this.bind(te.particle_image,d.textures[0]),c.PARTICLES=1}return e.linear&&(c.LINEAR=1),n&&(c.GREY=1),this.draw("developed",c,o.colours),o.colours.textures[0]}present(e,t,r,{width:s,height:n},a){let{gl:o}=this;this.bind(te.level_0,e),o.bindFramebuffer(o.FRAMEBUFFER,t),o.viewport(r[0],r[1],s,n),o.useProgram(this.programs.get("presented",a?{}:{FLIPPED:1},"presented")),o.drawArrays(o.TRIANGLES,0,3)}drawScattered({sources:e,levels:t},r,s){let n=r.spreads.length;this.bind(te.surface_image,this.radiance),this.draw("scattered",{N_LEVELS:Math.min(n,1)},e[0]),n>1&&(this.bind(te.surface_image,e[0].textures[1]),this.draw("scattered",{WIDE:1,N_LEVELS:n-1},e[1]));for(let a=2;a<e.length;++a)e[a-1].textures.slice(1).forEach((o,l)=>this.bind(te.level_0+l,o)),this.draw("reduced",{N_LEVELS:e[a].textures.length},e[a]);for(let a=t.length-1;a>=0;--a){let o=r.spreads[a]??0,l=ff(o);this.bind(te.level_0,e[a].textures[0]),o>0&&(this.draw("blurred_rows",{...l},t[a].rows),this.bind(te.level_0,t[a].rows.textures[0])),a+1<t.length&&(this.bind(te.level_1,t[a+1].total.textures[0]),l.WIDER=1),a===0&&s&&(this.bind(te.level_2,e[0].textures.at(-1)),l.LAMPS=s),n||(l.VEIL_ONLY=1),this.draw("blurred",l,t[a].total)}}begin(e){this.gl.bindFramebuffer(this.gl.FRAMEBUFFER,e.buffer),this.gl.viewport(0,0,e.width,e.height)}draw(e,t,r){let{gl:s}=this;this.begin(r),s.useProgram(this.programs.get(e,{...this.switches,...t},"screen")),s.drawArrays(s.TRIANGLES,0,3)}bind(e,t){this.gl.activeTexture(this.gl.TEXTURE0+e),this.gl.bindTexture(this.gl.TEXTURE_2D,t),this.gl.activeTexture(this.gl.TEXTURE0)}tableOf(e,t){let r=t.deviations.join(),s=this.tables.find(a=>a.key===r&&a.optics===e.transform);if(s)return s.texture;this.tables.length>=$p&&this.gl.deleteTexture(this.tables.shift().texture);let n=this.texture(128,9,this.format);return this.upload(n,128,9,hf(e,t,9)),this.tables.push({optics:e.transform,key:r,texture:n}),n}targetsOf({width:e,height:t},r){let{gl:s,format:n}=this,a=r.deviations.length,o=`${e} ${t} ${a}`,l=this.targets.get(o);if(l)return l;this.targets.size>7&&this.deleteTargets(),l={surfaces:this.depthTarget(e,t),wateredSurfaces:null,colours:this.target(e,t,1,s.RGBA8),particles:null,sources:[],levels:[]};let[c,d]=[e,t];for(let h=0;h<Math.max(a,1);++h){[c,d]=[Math.ceil(c/2),Math.ceil(d/2)];let m=h===0?Math.min(a,1)+1:a-h;l.sources.push(this.target(c,d,m,n)),l.levels.push({rows:this.target(c,d,1,n),total:this.target(c,d,1,n)})}return this.targets.set(o,l),l}depthTarget(e,t){let{gl:r}=this,s=r.createRenderbuffer();r.bindRenderbuffer(r.RENDERBUFFER,s),r.renderbufferStorage(r.RENDERBUFFER,r.DEPTH_COMPONENT24,e,t);let n=this.target(e,t,1,this.format);return r.framebufferRenderbuffer(r.FRAMEBUFFER,r.DEPTH_ATTACHMENT,r.RENDERBUFFER,s),{...n,depth:s}}target(e,t,r,s){let{gl:n}=this,a=Array.from({length:r},()=>this.texture(e,t,s)),o=n.createFramebuffer();return n.bindFramebuffer(n.FRAMEBUFFER,o),a.forEach((l,c)=>n.framebufferTexture2D(n.FRAMEBUFFER,n.COLOR_ATTACHMENT0+c,n.TEXTURE_2D,l,0)),n.drawBuffers(a.map((l,c)=>n.COLOR_ATTACHMENT0+c)),{buffer:o,textures:a,width:e,height:t}}texture(e,t,r){let{gl:s}=this,n=s.createTexture();s.bindTexture(s.TEXTURE_2D,n),s.texStorage2D(s.TEXTURE_2D,1,r,e,t);for(let a of[s.TEXTURE_MIN_FILTER,s.TEXTURE_MAG_FILTER])s.texParameteri(s.TEXTURE_2D,a,s.LINEAR);for(let a of[s.TEXTURE_WRAP_S,s.TEXTURE_WRAP_T])s.texParameteri(s.TEXTURE_2D,a,s.CLAMP_TO_EDGE);return n}upload(e,t,r,s){let{gl:n}=this;n.bindTexture(n.TEXTURE_2D,e),n.texSubImage2D(n.TEXTURE_2D,0,0,0,t,r,n.RGBA,n.FLOAT,s)}deleteTargets(){let{gl:e}=this;for(let{surfaces:t,wateredSurfaces:r,colours:s,particles:n,sources:a,levels:o}of this.targets.values())for(let l of[t,s,...[r,n].filter(c=>c!==null),...a,...o.flatMap(({rows:c,total:d})=>[c,d])]){for(let c of l.textures)e.deleteTexture(c);e.deleteFramebuffer(l.buffer),l.depth&&e.deleteRenderbuffer(l.depth)}this.targets.clear()}};var Mi=128,Qp=[-1,-.32,10,-3,.45],Mf=[4,-.7],[Jp,Tf]=[50,154],Zp=[.2126,.7152,.0722],eg=[[3.2406,-1.5372,-.4986],[-.9689,1.8758,.0415],[.0557,-.204,1.057]],tg=.01;function Rf(i,e,t){let r=Mi,s=new Float32Array(8*r*r),n=fa(i,0,t,!0);for(let a=0;a<r;++a)for(let o=0;o<r;++o){let[l,c]=[o,a].map(w=>2*w/(r-1)-1),d=Math.hypot(l,c),h=Math.min(d*d,1),m=2/(1+h)/Math.max(d,1),v=[m*l,m*c,(1-h)/(1+h)],y=4*(r*a+o);s.set(rg(e,v).map(w=>t*w),y),s.set(n([v[0],v[1],-v[2]]),4*r*r+y)}return s}function rg(i,e){let t=Math.max(e[2],tg),r=Math.min(Math.max(le(e,i.sun),-1),1),[s,n,a,o,l]=Qp,c=1+s*Math.exp(n/t),d=1+a*(Math.exp(o*Math.acos(r))-Math.exp(o*Math.PI/2))+l*r*r,h=i.clear*c*d,m=i.overcast*(1+Mf[0]*Math.exp(Mf[1]/t));return ig(Tf+(Jp-Tf)*Math.sqrt(t)).map(v=>h*v+m)}function ig(i){let e=i*.001,t=.244063+e*(.09911+e*(2.9678-e*4.607)),r=.23704+e*(.24748+e*(1.9018-e*2.0064)),s=i>1e6/7e3?t:r,n=-3*s*s+2.87*s-.275,a=eg.map(l=>Math.max(le(l,[s/n,1,(1-s-n)/n]),0)),o=le(a,Zp);return a.map(l=>l/o)}var sr=128,Lf=[.2,.8,3.2,12.8],pa=192,Pf=[.2,.4,.8,1.6],sg=4,ng=6,ag=.25,og=4.5,Cf=9.81,Ls=class{constructor(e,t,r){this.gl=e;this.programs=t;this.format=r;this.textures=[e.createTexture(),e.createTexture()];for(let s of this.textures){e.bindTexture(e.TEXTURE_2D,s);for(let n of[e.TEXTURE_MIN_FILTER,e.TEXTURE_MAG_FILTER])e.texParameteri(e.TEXTURE_2D,n,e.NEAREST)}}gl;programs;format;textures;texture(e,t,r){let{gl:s}=this,n=r?s.TEXTURE_2D_ARRAY:s.TEXTURE_2D,a=s.createTexture();s.bindTexture(n,a),r?s.texStorage3D(n,1,this.format,e,e,r):s.texStorage2D(n,1,this.format,e,e);for(let l of[s.TEXTURE_MIN_FILTER,s.TEXTURE_MAG_FILTER])s.texParameteri(n,l,s.LINEAR);for(let l of[s.TEXTURE_WRAP_S,s.TEXTURE_WRAP_T])s.texParameteri(n,l,t);let o=Array.from({length:r??1},(l,c)=>{let d=s.createFramebuffer();return s.bindFramebuffer(s.FRAMEBUFFER,d),r?s.framebufferTextureLayer(s.FRAMEBUFFER,s.COLOR_ATTACHMENT0,a,0,c):s.framebufferTexture2D(s.FRAMEBUFFER,s.COLOR_ATTACHMENT0,n,a,0),d});return{texture:a,buffers:o}}draw({amplitude:e,omega:t,kx:r,ky:s,phase:n},[a,o],l,c,d,h){let{gl:m}=this,v=Math.max(e.length,1),[y,w]=[0,1].map(()=>new Float32Array(4*v*d));for(let x=0;x<e.length;++x){let S=r[x]*a+s[x]*o-t[x]*c+n[x],E=t[x]*t[x]/Cf,T=4*d*x;If(y,T,d,1,S,r[x]*l,[r[x],E]),If(w,T,d,e[x],0,s[x]*l,[s[x],0])}[y,w].forEach((x,S)=>{m.activeTexture(m.TEXTURE0+[te.factors_x,te.factors_y][S]),m.bindTexture(m.TEXTURE_2D,this.textures[S]),m.texImage2D(m.TEXTURE_2D,0,m.RGBA32F,d,v,0,m.RGBA,m.FLOAT,x)}),m.activeTexture(m.TEXTURE0),m.bindFramebuffer(m.FRAMEBUFFER,h),m.viewport(0,0,d,d),m.disable(m.DEPTH_TEST),m.disable(m.CULL_FACE),m.disable(m.BLEND),m.bindVertexArray(null),m.useProgram(this.programs.get("wave_grid",{},"screen")),m.drawArrays(m.TRIANGLES,0,3)}},Ps=class{constructor(e,t){this.sums=t;this.grids=t.texture(sr,e.CLAMP_TO_EDGE,Lf.length),this.nearGrid=t.texture(pa,e.CLAMP_TO_EDGE)}sums;grids;nearGrid;frames=[];maxElevation=0;slopeVariance=0;hasFoam=!1;components=null;scale=1;keys=new Map;set(e,t){if(e===this.components&&t===this.scale||([this.components,this.scale]=[e,t],this.frames=[],this.keys.clear(),[this.maxElevation,this.slopeVariance,this.hasFoam]=[0,0,!1],!e))return;let r=[...e.amplitude].map(n=>t*n),s=r.map((n,a)=>n*e.omega[a]**2/Cf);this.maxElevation=Ff(r,ng),this.slopeVariance=kf(e,t,()=>!0),this.hasFoam=Ff(s,og)>ag}update(e,t){this.frames=Lf.map((r,s)=>this.draw(e,t,r,sr,this.grids.buffers[s]))}updateNear(e,t,r){let s=r/(.5*pa-2),n=Pf.find(a=>a>=s)??Pf.at(-1);this.frames=[this.draw(e,t,n,pa,this.nearGrid.buffers[0])]}draw(e,t,r,s,n){let a=this.components,o=h=>h*sg*r<=2*Math.PI,l=[0,1].map(h=>r*(Math.floor(t[h]/r+.5)-s/2)),c=`${e} ${r} ${l}`;this.keys.get(n)!==c&&(this.keys.set(n,c),this.sums.draw(lg(a,this.scale,o),l,r,e,s,n));let d=kf(a,this.scale,h=>!o(h));return{origin:l,spacing:r,nPoints:s,roughness:d}}};function If(i,e,t,r,s,n,a){let[o,l]=[r*Math.cos(s),r*Math.sin(s)],[c,d]=[Math.cos(n),Math.sin(n)];for(let h=e;h<e+4*t;h+=4){i[h]=o,i[h+1]=l,i[h+2]=a[0],i[h+3]=a[1];let m=o*c-l*d;l=l*c+o*d,o=m}}function lg({amplitude:i,omega:e,kx:t,ky:r,phase:s},n,a){let o=(v,y)=>a(Math.hypot(t[y],r[y])),[l,c,d,h,m]=[i,e,t,r,s].map(v=>v.filter(o));return{amplitude:l.map(v=>n*v),omega:c,kx:d,ky:h,phase:m}}function kf({amplitude:i,kx:e,ky:t},r,s){let n=0;for(let a=0;a<i.length;++a){let o=Math.hypot(e[a],t[a]);s(o)&&(n+=.25*(r*i[a]*o)**2)}return n}function Ff(i,e){let t=i.reduce((s,n)=>s+n*n,0),r=i.reduce((s,n)=>s+n,0);return Math.min(r,e*Math.sqrt(.5*t))}var nr=5.3,Of=2,[Nf,Df]=[.55,.43],cg=.00465,fg=1.34,ug=96;function Uf(i,e,t,r,s,n,a,o){let l=ve(n),c=Ae([n[0],n[1],n[2],0,n[4],n[5],n[6],0,n[8],n[9],n[10],0,0,0,0,1]),d=Ae([n[0],n[4],n[8],0,n[1],n[5],n[9],0,n[2],n[6],n[10],0,0,0,0,1]),h=S=>S.map(E=>o*E),m=[0,1,2,3].map(S=>{let E=t.frames[S];if(!E)return[0,0,0,0];let{origin:T,spacing:A,nPoints:G}=E;return[...[0,1].map(D=>((l[D]-T[D])/A+.5)/G),1/(A*G),A]}),[v,y]=[Math.cos(Nf)/Df,Math.sin(Nf)/Df],w=[v*l[0]-y*l[1],y*l[0]+v*l[1]],x=new Float32Array(ug);return x.set([...wt(Pe(er(a,!0),d)),...wt(c),r,a.near,0,t.frames.length,...m.flat(),...[0,1,2,3].map(S=>t.frames[S]?.roughness??0),Math.sqrt(s/Of),s/Of,1/nr,nr/sr,Is(l[0],5*nr),Is(l[1],5*nr),0,0,Is(w[0],nr),Is(w[1],nr),v,y,t.maxElevation,t.slopeVariance,0,0,...i.sky.sun,cg,...h(i.sky.sunlight),e.sun[2],...h(i.sky.light),0,...e.reflectance.map((S,E)=>o*S*e.total[E]),0,a.width,a.height,0,0,i.air,fg,1/Math.sqrt(a.fx*a.fy),0]),x}function Is(i,e){return i-e*Math.floor(i/e)}var Ar=32,ks=8,[hg,Vf,ga]=[.2,1500,2e5],dg=170,zf=12,Fs=class{constructor(e){this.gl=e;let t=this.radii=vg(),r=Ar*ks,s=r+1,n=t.flatMap(o=>Array.from({length:s},(l,c)=>2*Math.PI*c/r).flatMap(l=>[o*Math.cos(l),o*Math.sin(l)])),a=[];for(let o=0;o<Ar;++o)for(let l=0;l<t.length-1;++l)for(let c=0;c<ks;++c){let d=s*l+ks*o+c,h=d+s;a.push(d,h,h+1,d,h+1,d+1)}this.vertexArray=e.createVertexArray(),e.bindVertexArray(this.vertexArray),e.bindBuffer(e.ARRAY_BUFFER,e.createBuffer()),e.bufferData(e.ARRAY_BUFFER,Float32Array.from(n),e.STATIC_DRAW),e.enableVertexAttribArray(Sr.vertex),e.vertexAttribPointer(Sr.vertex,2,e.FLOAT,!1,0,0),e.bindBuffer(e.ELEMENT_ARRAY_BUFFER,e.createBuffer()),e.bufferData(e.ELEMENT_ARRAY_BUFFER,Uint32Array.from(a),e.STATIC_DRAW),e.bindVertexArray(null)}gl;vertexArray;radii;draw({sectors:e,minRadius:t,maxRadius:r}){let{gl:s,radii:n}=this,a=6*ks,o=Math.max(Gf(n,t)-2,0),l=Math.min(Gf(n,r)+1,n.length-1)-o;if(!(l<=0)){s.bindVertexArray(this.vertexArray);for(let c of e){let d=c*(n.length-1)*a+o*a;s.drawElements(s.TRIANGLES,l*a,s.UNSIGNED_INT,4*d)}s.bindVertexArray(null)}}};function Bf(i,e,t,r){let s=mg(e).map(([w,x])=>{let S=-(x-e.cy)/e.fy;return Yr(i,[(w-e.cx-e.skew*S)/e.fx,S,-1])}),n=gg(i,e),a=n?Array.from({length:Ar},(w,x)=>x):pg(i,s),o=t>0?-1:1,[l,c]=[Math.abs(t)-r,Math.abs(t)+r],d=s.map(([w,x,S])=>o*S/Math.hypot(w,x)),[h,m]=[1.05*Math.max(...d),.95*Math.min(...d)],[v,y]=[0,ga];if(l>0){!n&&h<=0&&(a=[]),n||(v=l/Math.max(h,1e-9));let w=o*i[10]<0;m>0&&(!n||w)&&(y=Math.min(c/m,ga))}return{sectors:a,minRadius:v,maxRadius:y}}function mg({width:i,height:e}){return Array.from({length:zf},(t,r)=>r/(zf-1)).flatMap(t=>{let[r,s]=[i*t-.5,e*t-.5];return[[r,-.5],[r,e-.5],[-.5,s],[i-.5,s]]})}function pg(i,e){let t=Math.atan2(-i[6],-i[2]),r=e.map(([l,c])=>{let d=Math.atan2(c,l)-t;return d-2*Math.PI*Math.floor(d/(2*Math.PI)+.5)}),s=2*Math.PI/Ar,n=Math.floor((t+Math.min(...r))/s-.25),a=Math.floor((t+Math.max(...r))/s+.25),o=new Set;for(let l=n;l<=a;++l)o.add((l%Ar+Ar)%Ar);return[...o].sort((l,c)=>l-c)}function gg(i,e){return[1,-1].some(t=>{let[r,s,n]=[t*i[8],t*i[9],t*i[10]];if(n>=-1e-6)return!1;let a=e.fx*r/-n+e.skew*s/-n+e.cx,o=-e.fy*s/-n+e.cy,l=.1*e.width;return-l<=a&&a<=e.width+l&&-l<=o&&o<=e.height+l})}function Gf(i,e){let t=i.findIndex(r=>r>=e);return t<0?i.length:t}function vg(){let i=(e,t,r)=>Array.from({length:r},(s,n)=>e*(t/e)**(n/(r-1)));return[0,...i(hg,Vf,dg),...i(Vf,ga,16).slice(1)]}var _g=.01,Cs=class{constructor(e,t,r,s,n){this.gl=e;this.programs=t;this.spec=r;this.formatSwitches=n;this.sums=new Ls(e,t,s),this.grids=new Ps(e,this.sums),this.ripples=this.sums.texture(sr,e.REPEAT),this.hemispheres=e.createTexture(),e.bindTexture(e.TEXTURE_2D_ARRAY,this.hemispheres),e.texStorage3D(e.TEXTURE_2D_ARRAY,1,s,Mi,Mi,2);for(let[a,o]of[[e.TEXTURE_MIN_FILTER,e.LINEAR],[e.TEXTURE_MAG_FILTER,e.LINEAR],[e.TEXTURE_WRAP_S,e.CLAMP_TO_EDGE],[e.TEXTURE_WRAP_T,e.CLAMP_TO_EDGE]])e.texParameteri(e.TEXTURE_2D_ARRAY,a,o);this.mesh=new Fs(e)}gl;programs;spec;formatSwitches;sums;grids;ripples;hemispheres;mesh;ripplesKey=[];hemispheresKey=[];switches={};sides=[];view={sectors:[],minRadius:0,maxRadius:0};prepare({time:e,scale:t,waves:r,ripples:s},n,a,o,l,c){let{grids:d,spec:h}=this;d.set(r,t);let m=ve(o),v=m[2]-a,y=d.maxElevation+2*l.near;this.sides=[...v>-y?[!0]:[],...v<y?[!1]:[]],this.view=Bf(o,l,v,y),this.isDirect&&(this.view.maxRadius=Math.min(this.view.maxRadius,yg(n))),this.switches={...this.formatSwitches};let w=0;r&&this.view.sectors.length&&(w=d.slopeVariance,this.isDirect?d.updateNear(e,m,this.view.maxRadius):d.update(e,m),this.switches.WAVES=d.frames.length,d.hasFoam&&(this.switches.FOAM=1));let x=s?Math.max(h.slope_variance-w,0):0;return s&&x>0&&((this.ripplesKey[0]!==s||this.ripplesKey[1]!==e)&&(this.ripplesKey=[s,e],this.sums.draw(s,[0,0],nr/sr,e,sr,this.ripples.buffers[0])),this.switches.RIPPLES=1),this.updateHemispheres(n,c),Uf(h,n,d,v,x,o,l,c)}get isDirect(){return this.sides.length===1&&!this.sides[0]}drawAmong(){this.useTextures(),this.drawSides({DIRECT:1}),this.gl.depthFunc(this.gl.LEQUAL)}draw(e){let{gl:t}=this;this.useTextures(),t.disable(t.DEPTH_TEST),t.disable(t.CULL_FACE),t.bindVertexArray(null),t.useProgram(this.programs.get("air",this.switches,"screen")),t.drawArrays(t.TRIANGLES,0,3),t.enable(t.DEPTH_TEST),t.depthFunc(t.LESS),this.drawSides(e?{BODIES_ABOVE:1}:{}),t.depthFunc(t.LEQUAL)}drawSides(e){let{gl:t}=this;t.enable(t.CULL_FACE),t.frontFace(t.CW);for(let r of this.sides){t.cullFace(r?t.BACK:t.FRONT);let s=r?{ABOVE:1}:{};t.useProgram(this.programs.get("water_surface",{...this.switches,...e,...s})),this.mesh.draw(this.view)}t.cullFace(t.BACK),t.disable(t.CULL_FACE)}useTextures(){let{gl:e}=this;for(let[t,r,s]of[[te.wave_grids,e.TEXTURE_2D_ARRAY,this.grids.grids.texture],[te.wave_grid,e.TEXTURE_2D,this.grids.nearGrid.texture],[te.ripple_tile,e.TEXTURE_2D,this.ripples.texture],[te.hemispheres,e.TEXTURE_2D_ARRAY,this.hemispheres]])e.activeTexture(e.TEXTURE0+t),e.bindTexture(r,s);e.activeTexture(e.TEXTURE0)}updateHemispheres(e,t){let{gl:r}=this,s=[e.transform,t];if(s.every((o,l)=>o===this.hemispheresKey[l]))return;this.hemispheresKey=s;let n=Rf(e,this.spec.sky,t);r.activeTexture(r.TEXTURE0+te.hemispheres),r.bindTexture(r.TEXTURE_2D_ARRAY,this.hemispheres);let a=Mi;r.texSubImage3D(r.TEXTURE_2D_ARRAY,0,0,0,0,a,a,2,r.RGBA,r.FLOAT,n),r.activeTexture(r.TEXTURE0)}};function yg({absorption:i,scattering:e,field:t}){let r=Array.from({length:48},(n,a)=>2*1.25**a),s=r.filter(n=>i.some((a,o)=>{let l=t[0]+t[1]*Math.sqrt(a*n);return Math.exp(-n*(a+l*e[o]))>_g}));return s.length?s.at(-1)*1.25:r[0]}function Hf({worldFromCamera:i,intrinsics:e,water:t,optics:r},s,n,a,o){let{near:l,far:c}=e,{ambient:d,specular:h,suns:m}=s,v=t.light_rate,y=r?.absorption.map((T,A)=>T+r.scattering[A])??t.attenuation,w=t.follows_light===!1?1:v,[x,S]=[t.colour,t.fog_colour].map(T=>T.map(A=>w*A)),E=t.fog>0?S:x;return Float32Array.from([...wt(n),...wt(Pe(o.textureFromWorld,i)),i[8],i[9],i[10],ve(i)[2]-t.surface_height,...Vi(i,a),o.lift,...m[t.sun].colour.map(T=>v*T),0,v*d,v*h,0,0,...x,0,...y,0,...S,t.fog**2,(c+l)/(c-l),-2*c*l/(c-l),0,0,...E,0])}var va=256,Os=class{constructor(e,t){this.gl=e;this.models=t;this.values=new Float32Array(va/4*Math.max(1,t.instances.length)),this.buffer=e.createBuffer()}gl;models;values;buffer;fill(e,t){this.models.instances.forEach((r,s)=>{let n=va/4*s;this.values.set(wt(Pe(e,r.worldFromMesh)),n),t&&this.values.set(wt(Pe(t,r.normals)),n+16)}),this.gl.bindBuffer(this.gl.UNIFORM_BUFFER,this.buffer),this.gl.bufferData(this.gl.UNIFORM_BUFFER,this.values,this.gl.STREAM_DRAW)}drawPiece({instance:e,firstIndex:t,count:r},s){let n=this.gl;e.visual.two_sided?n.disable(n.CULL_FACE):n.enable(n.CULL_FACE),n.frontFace(e.isMirrored!==s?n.CW:n.CCW),n.bindBufferRange(n.UNIFORM_BUFFER,Er.Instance,this.buffer,va*e.index,160),n.bindVertexArray(e.vertexArray);let[a,o]=e.hasUint32Indices?[n.UNSIGNED_INT,4]:[n.UNSIGNED_SHORT,2];n.drawElements(n.TRIANGLES,r,a,o*t)}};var bg=5,wg=320*240,Wf=4;function Ti(i){let e=i.getExtension("WEBGL_debug_renderer_info"),t=e?String(i.getParameter(e.UNMASKED_RENDERER_WEBGL)):"";return/swiftshader|llvmpipe|software|softpipe/i.test(t)}var Ns=class{constructor(e,t,r){this.gl=e;this.head=t;this.models=r;this.isSoftware=Ti(e),this.programs=new vs(e),this.instanceBlocks=new Os(e,r),this.shadows=new Es(e,this.programs,this.instanceBlocks);let{nodes:s}=t.water;this.development=s?Rs.make(e,this.programs,s):null,this.surfacePass=t.surface&&this.development?new Cs(e,this.programs,t.surface,this.development.format,this.development.switches):null,this.samplers=[e.CLAMP_TO_EDGE,e.REPEAT].map(n=>{let a=e.createSampler();return e.samplerParameteri(a,e.TEXTURE_MIN_FILTER,e.LINEAR),e.samplerParameteri(a,e.TEXTURE_MAG_FILTER,e.LINEAR),e.samplerParameteri(a,e.TEXTURE_WRAP_S,n),e.samplerParameteri(a,e.TEXTURE_WRAP_T,n),a})}gl;head;models;isSoftware;programs;instanceBlocks;shadows;blocks={};samplers;development;surfacePass;get lacksFloats(){return!!this.head.water.nodes&&!this.development}draw(e,t,r,s=!1){e.optics&&this.development?this.drawPhysical(e,e.optics,t,r,s):this.drawSurfaces(e,t,r,s,{})}drawPhysical(e,t,r,s,n){let a=this.development,{worldFromCamera:o,water:l}=e,c=this.isSoftware&&!e.isExact,d=this.isSoftware||e.isExact||devicePixelRatio>=2?1:2,h=hi(e.intrinsics,d),m=h.width*h.height>wg,v=a.plan(h,t.blur&&!(c&&m)),y=e.lamps.slice(0,Wf),w=l.surface_height-ve(o)[2],x=e.surface?this.surfacePass:null;if(x){let I=x.prepare(e.surface,t,l.surface_height,o,h,l.light_rate);this.fill("Surface",I)}let S=a.prepare(t,o,h,v,w,l.light_rate,x!==null);this.fill("Optics",lf(t,h,y,l.light_rate,v.reach));let E=x?.isDirect,T={PHYSICAL:1,...x?{SKY:1}:{},...a.switches};if(this.drawSurfaces({...e,intrinsics:h,grey:!1},S,[0,0],!0,T,()=>E&&x.drawAmong()),y.length&&this.drawLampPoints(y.length,a.switches),x&&!E){let I=({corners:D})=>D.some(U=>U[2]>l.surface_height);a.drawOver(()=>x.draw(this.shownPieces(e).some(I)))}this.gl.disable(this.gl.DEPTH_TEST);let A=this.findParticles(e,h),G=a.develop(t,h,v,y.length,e.grey===!0,A);a.present(G,r,s,e.intrinsics,n)}findParticles({drift:e,worldFromCamera:t,water:r},s){let n=this.head.particles;return!n||!e?null:{spec:n,records:Ms(n,e,t,s,r.surface_height)}}drawLampPoints(e,t){let{gl:r}=this;r.useProgram(this.programs.get("lamp_point",{COLOUR:0,LAMPS:e,...t})),r.depthMask(!1),r.enable(r.BLEND),r.blendFuncSeparate(r.ONE,r.ONE,r.ONE,r.ZERO),r.drawArrays(r.POINTS,0,e),r.disable(r.BLEND),r.depthMask(!0)}drawSurfaces(e,t,r,s,n,a=()=>{}){let{gl:o}=this,{worldFromCamera:l,intrinsics:c,water:d}=e,h=er(c,s),m={worldFromCamera:l,clip:h,intrinsics:c},v=this.shownPieces(e),y=ws(v,m),w={COLOUR:0,...n},x=d.fog>0;!n.PHYSICAL&&!x&&(w.NO_FOG=1),!n.PHYSICAL&&x&&d.clip&&!e.isExternal&&(w.FOG_CLIP=1),e.grey&&(w.GREY=1),e.isExternal&&Object.assign(w,n.SKY?{POLISHED:1}:{AIR:1,POLISHED:1}),e.isExternal&&!this.isSoftware&&(w.SOFT=1);let S=n.PHYSICAL?e.optics.sun:bt(this.head.suns[d.sun].direction);d.shadows&&this.updateSunShadows(v,y,S,m)&&(w.SHADOWS=1),this.lightScene(e,v,w),this.fill("Frame",Hf(e,this.head,h,S,this.shadows)),this.instanceBlocks.fill(ft(l),xg(l)),o.bindFramebuffer(o.FRAMEBUFFER,t),o.viewport(r[0],r[1],c.width,c.height),o.enable(o.SCISSOR_TEST),o.scissor(r[0],r[1],c.width,c.height),o.depthMask(!0),o.clear(o.DEPTH_BUFFER_BIT),o.enable(o.DEPTH_TEST),o.depthFunc(o.LEQUAL),o.disable(o.BLEND);for(let T of y.filter(Ai))this.drawPiece(T,m,w,s);this.drawBackground(e.grey?{COLOUR:0,GREY:1,...n}:{COLOUR:0,...n}),a(),o.enable(o.BLEND),o.blendFuncSeparate(o.SRC_ALPHA,o.ONE_MINUS_SRC_ALPHA,o.ZERO,o.ONE),o.depthMask(!1);for(let T of y.filter(A=>!Ai(A)).reverse()){let A=Math.round(255*T.instance.visual.opacity);A>0&&this.drawPiece(T,m,{...w,OPACITY:A},s)}this.models.maps?.release(),o.depthMask(!0),o.disable(o.BLEND),o.disable(o.SCISSOR_TEST),o.bindVertexArray(null)}shownPieces({isExternal:e}){return this.models.instances.filter(({visual:t})=>e||!t.hidden).flatMap(({pieces:t})=>t)}updateSunShadows(e,t,r,s){let n=e.filter(o=>Ai(o)&&this.models.radius(o.instance)<=bg),a=Qc(n,t,r,s);return a.length&&this.shadows.updateSunShadows(a,r,this.models.version),this.bind(te.shadow_map,this.shadows.sunMap.texture),a.length>0}lightScene(e,t,r){let s=e.lamps.slice(0,Wf);s.length&&(r.LAMPS=s.length,this.shadows.updateLampShadows(s,t,this.models.version),this.bind(te.lamp_maps,this.shadows.lampMaps.texture),this.fill("Lamps",af(s,e.worldFromCamera)));let{projector:n}=this.head;if(!n)return;r.PROJECTOR=1;let{width:a,height:o}=this.head.textures[n.pattern],l=this.models.worldFromMount(n),c=nf(n,a,o);this.shadows.updateProjectorShadows(l,c,t),this.bind(te.projector_map,this.shadows.projectorMap.texture),this.bind(te.projector_pattern,this.models.patterns[0]),this.fill("Projector",of(n,l,c,e.worldFromCamera))}drawPiece(e,t,r,s){let[{gl:n},{texture:a,repeats:o,visual:l}]=[this,e.instance],c=ef(e,t)?this.samplers:null;a&&(this.bind(te.base_map,a),n.bindSampler(te.base_map,c&&c[Number(o)]));let d=this.models.maps.use(l.material,a?{...r,TEXTURED:1}:r,c);n.useProgram(this.programs.get("surface",d)),this.instanceBlocks.drawPiece(e,s)}drawBackground(e){let{gl:t}=this;t.bindSampler(te.base_map,null),t.disable(t.CULL_FACE),t.bindVertexArray(null),t.useProgram(this.programs.get("background",e)),t.drawArrays(t.TRIANGLES,0,3)}fill(e,t){let{gl:r}=this;this.blocks[e]??=r.createBuffer(),r.bindBuffer(r.UNIFORM_BUFFER,this.blocks[e]),r.bufferData(r.UNIFORM_BUFFER,t,r.STREAM_DRAW),r.bindBufferBase(r.UNIFORM_BUFFER,Er[e],this.blocks[e])}bind(e,t){this.gl.activeTexture(this.gl.TEXTURE0+e),this.gl.bindTexture(this.gl.TEXTURE_2D,t),this.gl.activeTexture(this.gl.TEXTURE0)}};function xg(i){let e=i;return Ae([e[0],e[4],e[8],0,e[1],e[5],e[9],0,e[2],e[6],e[10],0,0,0,0,1])}var Eg=150;function Yf(i){let e=document.createElement("canvas").getContext("webgl2");if(!e)return null;let t=!Ti(e);return e.getExtension("WEBGL_lose_context")?.loseContext(),i.getContext("webgl2",{alpha:!1,antialias:t,powerPreference:"high-performance"})}var Ds=class i{constructor(e,t,r){this.gl=e;this.models=r;let s=this.head=t.head;this.media=new cs(t),this.surfaces=new ps(t,s),this.renderer=e&&new Ns(e,s,r),this.pacing=e&&Ti(e)?new bs(e):null;for(let n of s.cameras){let a=q("figure");a.append(q("figcaption",`${n.name} · redrawn, no noise`)),a.style.aspectRatio=`${n.width} / ${n.height}`,N("pictures").append(a),this.frames.push(a)}}gl;models;canvas=N("image");head;overlay=N("overlay");renderer;frames=[];images=[];pacing;media;surfaces;static async make(e,t){return new i(e,t,await ys.load(e,t))}draw(e,t,r,s){let{canvas:n,head:a,models:o}=this,l=this.gl&&Ti(this.gl)?1:Math.min(devicePixelRatio,2),[c,d]=[n.clientWidth,n.clientHeight];if(c===0||d===0)return null;for(let U of[n,this.overlay]){let[Y,X]=[Math.round(c*l),Math.round(d*l)];(U.width!==Y||U.height!==X)&&([U.width,U.height]=[Y,X])}o.place(t.poses),a.sand?.forEach((U,Y)=>o.setSand(Y,e.sand(Y,t.time)));let h=r.viewCamera(c,d),m=this.water(e,t,s),v=this.media.mediumAt(t),y=this.lamps(t),{worldFromCamera:w,isExternal:x}=h,S=hi(h.intrinsics,l),E=h.camera?.grey,T=t.drift(),A=this.surfaces.surfaceAt(e.trial,t),G={worldFromCamera:w,intrinsics:S,water:m,optics:v,lamps:y,isExternal:x,grey:E,drift:T,surface:A},I={...G,water:{...m,fog:0},optics:this.media.clearOptics(v),drift:null};this.renderer?.draw(s.clear?I:G,null,[0,0]);let D=this.overlay.getContext("2d");if(D.setTransform(l,0,0,l,0,0),D.clearRect(0,0,c,d),$c(D,w,h.intrinsics,a,o,e,t,s),h.camera&&aa(D,h.camera,h.intrinsics,0,0,t),r.mode==="map"){let U=N("hud");Kc(D,h.intrinsics,r.height,U.offsetTop+U.offsetHeight)}return this.frames.forEach((U,Y)=>U.hidden=a.cameras[Y]===h.camera),this.drawPictures(D,{...G,isExternal:!1},t,s,l,d),this.pacing?.begin(),h}get lacksFloats(){return this.renderer?.lacksFloats??!1}skipPauses(){this.pacing?.skipPauses()}isReady(){return this.pacing?.isReady(performance.now())??!0}image(e,t,r,s,n,a={}){let{gl:o,models:l,renderer:c}=this;if(!o||!c)return new Uint8Array;l.place(s.poses);let d=o.createFramebuffer();o.bindFramebuffer(o.FRAMEBUFFER,d);let h=[o.createRenderbuffer(),o.createRenderbuffer()];[o.RGBA8,o.DEPTH_COMPONENT24].forEach((E,T)=>{o.bindRenderbuffer(o.RENDERBUFFER,h[T]),o.renderbufferStorage(o.RENDERBUFFER,E,e.width,e.height);let A=T?o.DEPTH_ATTACHMENT:o.COLOR_ATTACHMENT0;o.framebufferRenderbuffer(o.FRAMEBUFFER,A,o.RENDERBUFFER,h[T])});let{isExternal:m=!1,isClear:v,grey:y}=a,w=this.media.mediumAt(s),x={worldFromCamera:t,intrinsics:e,lamps:this.lamps(s),isExternal:m,isExact:!0,grey:y,drift:v?null:s.drift(),surface:this.surfaces.surfaceAt(r.trial,s),optics:v?this.media.clearOptics(w):w,water:{...this.water(r,s,n),...a.water,...v?{fog:0}:{}}};c.draw(x,d,[0,0],!0);let S=new Uint8Array(4*e.width*e.height);o.readPixels(0,0,e.width,e.height,o.RGBA,o.UNSIGNED_BYTE,S);for(let E of h)o.deleteRenderbuffer(E);return o.deleteFramebuffer(d),S}pictureWidth(){let e=this.head.cameras.map(({width:t,height:r})=>t/r);return Math.round(Eg*Math.max(...e)*Math.min(devicePixelRatio,2))}show(e,t){this.frames[e]&&(this.images[e]?this.images[e].close():this.frames[e].querySelector("figcaption").textContent=this.head.cameras[e].name,this.images[e]=t)}drawPictures(e,t,r,s,n,a){if(N("pictures").hidden=!s.pictures,!s.pictures)return;let o=this.canvas.getBoundingClientRect();this.head.cameras.forEach((l,c)=>{if(this.frames[c].hidden)return;let d=this.frames[c].getBoundingClientRect(),[h,m]=[d.left-o.left+1,d.top-o.top+1],v=ia(l,d.width-2,d.height-2);if(this.images[c])e.drawImage(this.images[c],h,m,d.width-2,d.height-2);else{let y=this.models.worldFromMount(l),w=[Math.round(h*n),Math.round((a-m-d.height+2)*n)],{grey:x}=l,S={...t,worldFromCamera:y,intrinsics:hi(v,n),grey:x};this.renderer?.draw(S,null,w)}aa(e,l,v,h,m,r)})}water(e,t,r){let s=e.levels[gr(e,t.time)]?.level.values??{},{fog:n,light_rate:a}=this.head.water;return{...this.head.water,fog:t.signal("fog")??s.fog??n,light_rate:t.signal("light_rate")??s.light??a,sun:r.sun||this.head.water.sun}}lamps(e){return this.head.lamps.map((t,r)=>({lamp:t,index:r,brightness:e.signal(`lamp/${t.name}`)??Number(t.on)})).filter(({brightness:t})=>t>0).map(({lamp:t,index:r,brightness:s})=>({index:r,lamp:{...t,intensity:s*t.intensity},worldFromLamp:this.models.worldFromMount(t)}))}};var Ri=class{constructor(e,t,r,s={}){this.time=e;for(let[a,o]of Object.entries(s))this.poses.set(a,st(o));if(!t||!r)return;t.bodies.forEach((a,o)=>this.poses.set(a,st(r,7*o)));let n=7*t.bodies.length;t.signals.forEach((a,o)=>this.signals.set(a.name,r[n+o]))}time;poses=new Map;signals=new Map;signal(e){let t=this.signals.get(e);return t===void 0||Number.isNaN(t)?void 0:t}drift(){let e=t=>[..."xyz"].map(r=>this.signal(`${t}/${r}`)??0);return{displacement:e("particles"),velocity:e("particle_velocity"),time:this.time}}points(e,t){let r=[];for(let s=0;;++s){if(!this.signals.has(`${e}/${s}/${t[0]}`))return r;let n=t.map(a=>this.signal(`${e}/${s}/${a}`));n.every(a=>a!==void 0)&&r.push(n)}}};var Xf=6,Us=.2,Sg=30,Ag=1e4,Vs=class{constructor(e){this.pack=e;let t=e.head.trials??[];this.levels=t.flatMap(({levels:r},s)=>r.map(n=>({trial:s,level:n})))}pack;isLive=!1;levels;curves=[];trial=-1;version=0;title="";motion=null;trailStart=-1/0;get start(){let e=this.levels.filter(({trial:t})=>t===this.trial);return Math.min(this.motion?.head.start??1/0,e[0]?.level.start??0)}get end(){let e=this.levels.filter(({trial:t})=>t===this.trial);return Math.max(this.motion?.end??0,...e.map(({level:t})=>t.end))}async select(e){if(e===this.trial)return;let t=this.pack.head.trials?.[e];this.trial=e,this.motion=null,this.trailStart=-1/0,this.curves=[],t&&(this.title=t.title,this.curves=t.curves.map(({name:r,unit:s,times:n,values:a,names:o,is_share:l})=>({name:r,unit:s,names:o,isFraction:l,times:Array.from(this.pack.numbers(n),c=>c/Ag),values:Array.from(this.pack.numbers(a),c=>Number.isNaN(c)?null:c)})),t.motion&&(this.motion=await eo(this.pack.numbers(t.motion))))}snapshot(e){let t=this.pack.head.trials?.[this.trial]?.poses;return new Ri(e,this.motion?.head??null,this.motion?.row(e)??null,t)}speed(e,t){let r=this.motion,s=r?.head.bodies.indexOf(e)??-1;if(!r||s<0)return null;let n=r.head.start+(r.head.n-1)/r.head.rate,a=Math.min(n,Math.max(t,r.head.start+Us)),o=[a-Us,a].map(l=>[...r.row(l).slice(7*s,7*s+3)]);return qf(o[0],o[1],Us)}markers(e){let[t,r]=[this.motion,this.motion?.head.markers];if(!t||!r)return[];let s=t.rowIndex(e),n=new Map;for(let a of r.changes){if(a[0]>s)break;a.length>2?n.set(a[1],a):n.delete(a[1])}return[...n.values()].map(([,a,o,l,c])=>{let d=st(c),h=r.shapes[o].map(m=>m.map(v=>Ie(d,v)));return{name:a,at:c.slice(0,3),colour:l,lines:h}})}sand(e,t){let r=this.motion?.rowIndex(t)??-1;return this.motion?.removals.filter(s=>s.heap===e&&s.row<=r)??[]}trail(e,t){let r=this.motion,s=r?.head.bodies.indexOf(e)??-1;if(!r||s<0)return[];let{rate:n,start:a,n:o}=r.head,l=Math.min(o-1,Math.floor((t-a)*n)),c=[],d=Math.max(0,Math.ceil((this.trailStart-a)*n));for(let h=d;h<=l;h+=Math.max(1,Math.round(n/Xf))){let m=h*r.columns+7*s;c.push(Array.from(r.rows.subarray(m,m+3)))}return c}clearTrails(e){this.trailStart=e}};function qf(i,e,t){let r=Math.hypot(...e.map((s,n)=>s-i[n]))/t;return t>0&&r<Sg?r:null}var zs=class{constructor(e){this.head=e;this.title=e.title}head;isLive=!0;start=0;curves=[];levels=[];trial=0;end=0;title;version=0;currentMarkers=[];heights=new Map;row=null;recentRows=[];trails=[];push(e,t){let r=this.trails.at(-1);for(e===this.end&&(this.version+=1),e<this.end&&(this.trails.length=this.recentRows.length=0),(!r||e-r.time>=1/Xf)&&this.trails.push({time:e,row:t}),this.trails.length>2e4&&this.trails.splice(0,1e4),this.recentRows.push({time:e,row:t});this.recentRows.length>2&&this.recentRows[1].time<=e-Us;)this.recentRows.shift();this.row=t,this.end=e}speed(e){let t=this.head.motion?.bodies.indexOf(e)??-1,[r,s]=[this.recentRows[0],this.recentRows.at(-1)];if(t<0||!r||!s||s.time<=r.time)return null;let n=[r,s].map(({row:a})=>[0,1,2].map(o=>a[7*t+o]));return qf(n[0],n[1],s.time-r.time)}sample(e,t,r,s){let n=this.curves.find(a=>a.name===e);n||(n={name:e,unit:t,times:[],values:[]},this.curves.push(n)),n.times.push(r),n.values.push(s)}setLevels(e){this.levels.splice(0,this.levels.length,...e.map(t=>({trial:0,level:t}))),this.version+=1}async select(){}snapshot(){return new Ri(this.end,this.head.motion??null,this.row)}setMarkers(e){this.currentMarkers=e,this.version+=1}markers(){return this.currentMarkers}setSand(e,t){this.heights.set(e,t),this.version+=1}sand(e){return this.heights.get(e)??[]}trail(e){let t=this.head.motion?.bodies.indexOf(e)??-1;return t<0?[]:this.trails.map(({row:r})=>[0,1,2].map(s=>r[7*t+s]))}clearTrails(){this.trails.length=0}};var Mg=.5,Gs=class{constructor(e){this.pack=e}pack;cast(e,t,r,s){let n=1;for(let a of this.pack.head.bodies){if(!a.visuals.length||s(a))continue;let o=r(a.name);for(let l of a.visuals){if(l.hidden||l.opacity<Mg)continue;let c=Rg(Pe(o,Ae(l.matrix)));if(!c)continue;let[d,h]=[Ie(c,e),Ie(c,t)];n=Math.min(n,this.hitMesh(l,d,h,n))}}return n}hitMesh(e,t,r,s){let n=this.pack.head.meshes[e.mesh],a=Me(r,t,-1),o=le(a,a);for(let l of n.pieces){let c=Me([l[2],l[3],l[4]],t,-1),d=o>0?Math.min(s,Math.max(0,le(c,a)/o)):0,h=Me(c,a,-d);if(le(h,h)>l[5]*l[5])continue;let m=this.pack.numbers(n.positions),v=this.pack.numbers(n.triangles);for(let y=l[0];y<l[0]+l[1];y+=3)s=Math.min(s,Tg(m,v,y,t,a))}return s}};function Tg(i,e,t,r,s){let[n,a,o]=[3*e[t],3*e[t+1],3*e[t+2]],[l,c,d]=[i[n],i[n+1],i[n+2]],[h,m,v]=[i[a]-l,i[a+1]-c,i[a+2]-d],[y,w,x]=[i[o]-l,i[o+1]-c,i[o+2]-d],[S,E,T]=[s[0],s[1],s[2]],[A,G,I]=[E*x-T*w,T*y-S*x,S*w-E*y],D=h*A+m*G+v*I;if(Math.abs(D)<1e-14)return 1/0;let[U,Y,X]=[r[0]-l,r[1]-c,r[2]-d],P=(U*A+Y*G+X*I)/D;if(P<0||P>1)return 1/0;let[K,V,j]=[Y*v-X*m,X*h-U*v,U*m-Y*h],z=(S*K+E*V+T*j)/D;if(z<0||P+z>1)return 1/0;let J=(y*K+w*V+x*j)/D;return J>=0?J:1/0}function Rg(i){let e=[0,1,2].map(a=>[i[4*a],i[4*a+1],i[4*a+2]]),t=[it(e[1],e[2]),it(e[2],e[0]),it(e[0],e[1])],r=le(e[0],t[0]);if(Math.abs(r)<1e-18)return null;let s=[0,1,2].map(a=>t.map(o=>o[a]/r)),n=s.map(a=>-le(a,[i[3],i[7],i[11]]));return Ae([...s.flatMap((a,o)=>[...a,n[o]]),0,0,0,1])}function $f(i){let{player:e,picture:t}=i;Object.assign(window,{uwsim:{page:i,seek:r=>i.seek(r),go:r=>i.go(r),time:()=>i.time,level:()=>gr(e,i.time),curves:()=>Object.fromEntries(e.curves.map(r=>[r.name,$n(r,i.time)])),body:r=>Array.from(t.models.body(r)),markers:()=>e.markers(i.time),sand:r=>Array.from(t.models.heights(r)),particles:r=>{let{cameras:s,particles:n,water:a}=i.pack.head,o=s.find(d=>d.name===r),l=e.snapshot(i.time);t.models.place(l.poses);let c=t.models.worldFromMount(o);return Array.from(Ms(n,l.drift(),c,o,a.surface_height))},image:(r,s={})=>{let n=i.pack.head.cameras.find(c=>c.name===r),a=e.snapshot(i.time);t.models.place(a.poses);let o=t.models.worldFromMount(n),l={grey:n.grey,water:s};return jf(t.image(n,o,e,a,i.switches,l))},external:(r,s)=>{let[n]=i.pack.head.cameras,a={isExternal:!0,isClear:s},o=e.snapshot(i.time);return jf(t.image(n,Ae(r),e,o,i.switches,a))}}})}function jf(i){let e="";for(let t=0;t<i.length;t+=8192)e+=String.fromCharCode(...i.subarray(t,t+8192));return btoa(e)}var Lg="This browser does not support WebGL 2: the page shows no 3-D view, only the results (levels and curves).",Pg="This browser cannot draw into floating-point textures: the page shows the fog of the scene, not its physical water.";async function Ig(){let i=matchMedia("(prefers-color-scheme: dark)").matches;document.documentElement.dataset.theme=i?"dark":"light";let e=N("message");e.textContent="Loading…";try{let t=document.getElementById("pack"),r=Yf(N("image")),n=t?null:await Cl(r===null),a=n?n.pack:await di(Za(t.textContent??"")),o=await Ds.make(r,a),l=n?new zs(a.head):new Vs(a),c=new Gs(a),d=new ms(a,l,o,new ds(a.head,o.models,c),n,c);d.note=r||n?"":Lg,o.lacksFloats&&(d.note=Pg),e.textContent=d.note,n?.begin(d,l);let h=Number(new URLSearchParams(location.hash.slice(1)).get("level")??0);n||(await d.select(l.levels[h]?.trial??0),d.seek(l.levels[h]?l.levels[h].level.start:l.start)),$f(d)}catch(t){throw e.textContent=t instanceof Error?t.message:String(t),t}}Ig();})();
